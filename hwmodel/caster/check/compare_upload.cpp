// An upload is compared by plain loops over places. They share no code with the loops that lay out lines.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/shade.h"
#include "render/ground/ground_map.h"
#include "render/packet/field_bricks.h"

namespace voxmelt::hwmodel::raycast {
namespace {

class Comparison {
 public:
  explicit Comparison(const Memory& memory) : memory_(memory) {}
  void word(const char* volume, const state::Grid& brick, const state::Grid& place, std::int64_t expected,
            std::int64_t actual) {
    ++found.compared;
    if (expected != actual && !found.first) found.first = {volume, brick, place, expected, actual};
  }
  template <class Word>
  Word read(std::int64_t address) const {
    Word word;
    std::memcpy(&word, memory_.bytes.data() + address, sizeof word);
    return word;
  }
  UploadComparison found;

 private:
  const Memory& memory_;
};

// Returns the address of place (x, y, z) of the lattice in brick b. If bricks hold their aprons, the place
// may lie at -1 to 9 along an axis of the brick.
std::int64_t address_of(const Layout& layout, const state::Grid& b, int x, int y, int z) {
  if (layout.apron)
    return layout.address(layout.brick_at(b.x, b.y, b.z)) + layout.apron_offset(x, y, z, b.x, b.y, b.z);
  const int bits = layout.bits[0];
  return layout.address(layout.line_at(x >> bits, y >> bits, z >> bits)) + layout.offset(x, y, z);
}

template <class Word>
void compare_bricks(Comparison& to, const char* volume, const Layout& layout, const render::FieldData& field,
                    const Word* from, Word absent) {
  const int low = layout.apron ? -1 : 0, high = layout.apron ? 9 : 7;
  const state::Grid bricks{layout.count[0], layout.count[1], layout.count[2]};
  for (int bz = 0; bz < bricks.z; ++bz)
    for (int by = 0; by < bricks.y; ++by)
      for (int bx = 0; bx < bricks.x; ++bx) {
        const state::Grid b{bx, by, bz};
        const std::size_t slot = field.slots[bricks.index(bx, by, bz)];
        const bool stored = layout.brick_at(bx, by, bz) != 0;
        if (slot == 0 && !stored) continue;
        for (int z = low; z <= high; ++z)
          for (int y = low; y <= high; ++y)
            for (int x = low; x <= high; ++x) {
              const state::Grid place{8 * bx + x, 8 * by + y, 8 * bz + z};
              const std::size_t i = ((z + 1) * 11 + (y + 1)) * 11 + x + 1;
              const Word expected = slot == 0 ? absent : from[slot * render::kBrickVolume + i];
              const Word actual =
                  stored ? to.read<Word>(address_of(layout, b, place.x, place.y, place.z)) : absent;
              to.word(volume, b, place, expected, actual);
            }
      }
}

void compare_light(Comparison& to, const Memory& memory, const render::LightData& light) {
  for (int z = 0; z < light.count.z; ++z)
    for (int y = 0; y < light.count.y; ++y)
      for (int x = 0; x < light.count.x; ++x) {
        const auto word = to.read<LightWord>(memory.light.address(memory.light.line_at(x / 2, y / 2, z / 2)) +
                                             memory.light.offset(x, y, z));
        const std::uint8_t* expected = light.cells + 16 * ((z * light.count.y + y) * light.count.x + x);
        for (std::size_t i = 0; i < word.size(); ++i) to.word("light", {}, {x, y, z}, expected[i], word[i]);
      }
}

void compare_ground(Comparison& to, const Memory& memory, const render::GroundData& ground) {
  for (int z = 0; z < ground.cells.z; ++z)
    for (int x = 0; x < ground.cells.x; ++x) {
      const auto column = to.read<Column>(memory.heights.address(memory.heights.line_at(x / 4, 0, z / 4)) +
                                          memory.heights.offset(x, 0, z));
      const std::ptrdiff_t i = std::ptrdiff_t{z} * ground.row + x;
      to.word("drawn height", {}, {x, 0, z}, ground.drawn[i], column.drawn);
      to.word("bare height", {}, {x, 0, z}, ground.bare[i], column.bare);
    }
  const std::vector<picture::Texel>& texels = ground.map->texels();
  if (texels.empty()) return;
  const int wide = static_cast<int>(ground.cells.x) << ground.fineness;
  for (int i = 0; i < std::ssize(texels); ++i) {
    const int x = i % wide, z = i / wide;
    const auto texel = to.read<Texel>(memory.texels.address(memory.texels.line_at(x / 4, 0, z / 4)) +
                                      memory.texels.offset(x, 0, z));
    const picture::Texel& expected = texels[i];
    to.word("texel red", {}, {x, 0, z}, expected.red, texel.red);
    to.word("texel green", {}, {x, 0, z}, expected.green, texel.green);
    to.word("texel blue", {}, {x, 0, z}, expected.blue, texel.blue);
    to.word("texel bump", {}, {x, 0, z}, expected.bump_x, texel.bump_x);
    to.word("texel bump", {}, {x, 0, z}, expected.bump_z, texel.bump_z);
  }
}

// Finds the blocks of ground that read a column: their cells lie up to one beside it. Bounds are in 2^-6
// cells.
class LeastBounds {
 public:
  LeastBounds(int cells, int blocks) : cells_(cells), blocks_(blocks) {}
  // Visits the blocks that read the columns `from` to `from` + `more`, along an axis. Beyond the grid the
  // nearest column is read.
  template <class Visit>
  void readers(int from, int more, const Visit& visit) const {
    for (int block = 0; block < blocks_; ++block) {
      const int low = 4 * block - 1, high = 4 * block + 4;
      if (std::clamp(low, 0, cells_ - 1) <= from && from + more <= std::clamp(high, 0, cells_ - 1))
        visit(block);
    }
  }

 private:
  int cells_, blocks_;
};

void compare_bounds(Comparison& to, const GroundBlocks& blocks, const render::GroundData& ground) {
  const int nx = static_cast<int>(ground.cells.x), nz = static_cast<int>(ground.cells.z);
  const int wide = (nx + 3) / 4, deep = (nz + 3) / 4, coarse = (wide + 3) / 4;
  to.word("blocks of ground along x", {}, {}, wide, blocks.x);
  to.word("blocks of ground along z", {}, {}, deep, blocks.z);
  if (to.found.first) return;
  const LeastBounds x(nx, wide), z(nz, deep);
  std::vector<GroundBlock> fine(static_cast<std::size_t>(wide) * deep);
  std::vector<std::int32_t> rough(static_cast<std::size_t>(coarse) * ((deep + 3) / 4));
  const auto height = [&](int cx, int cz) { return ground.drawn[std::ptrdiff_t{cz} * ground.row + cx]; };
  const auto raise = [](std::int32_t& bound, std::int32_t by) { bound = std::max(bound, (by + 63) / 64); };
  for (int cz = 0; cz < nz; ++cz)
    for (int cx = 0; cx < nx; ++cx) {
      const auto demand = [&](int more_x, int more_z, const auto& one) {
        if (cx + more_x >= nx || cz + more_z >= nz) return;
        x.readers(cx, more_x,
                  [&](int bx) { z.readers(cz, more_z, [&](int bz) { one(bz * wide + bx, bx, bz); }); });
      };
      demand(0, 0, [&](std::size_t i, int bx, int bz) {
        raise(fine[i].highest, height(cx, cz));
        raise(rough[bz / 4 * coarse + bx / 4], height(cx, cz));
      });
      demand(1, 0, [&](std::size_t i, int, int) {
        raise(fine[i].slope_x, std::abs(height(cx + 1, cz) - height(cx, cz)));
      });
      demand(0, 1, [&](std::size_t i, int, int) {
        raise(fine[i].slope_z, std::abs(height(cx, cz + 1) - height(cx, cz)));
      });
    }
  for (int i = 0; i < std::ssize(fine); ++i) {
    const state::Grid at{i % wide, 0, i / wide};
    to.word("bound of heights", {}, at, fine[i].highest, blocks.fine[i].highest);
    to.word("bound of slopes along x", {}, at, fine[i].slope_x, blocks.fine[i].slope_x);
    to.word("bound of slopes along z", {}, at, fine[i].slope_z, blocks.fine[i].slope_z);
  }
  for (int i = 0; i < std::ssize(rough); ++i)
    to.word("bound of heights, 16 x 16 cells", {}, {i % coarse, 0, i / coarse}, rough[i], blocks.coarse[i]);
}

// Bit 31 of a record says that a block is empty. The low byte is its distance, or the slope's bound.
void compare_skip_map(Comparison& to, const Registers& registers, const render::FieldData& field) {
  const SkipMap& skip = registers.skip;
  to.word("blocks along x", {}, {}, field.blocks_x, skip.x);
  to.word("blocks along y", {}, {}, field.blocks_y, skip.y);
  for (int z = 0; z < skip.z; ++z)
    for (int y = 0; y < skip.y; ++y)
      for (int x = 0; x < skip.x; ++x) {
        const std::int32_t record = field.records[(std::ptrdiff_t{z} * skip.y + y) * skip.x + x];
        to.word("skip map", {}, {x, y, z}, record < 0 ? (record & 255) + 256 : record & 255,
                skip.at(x, y, z));
      }
}

}  // namespace

UploadComparison compare_upload(const Registers& registers, const Memory& memory,
                                const render::PictureData& data) {
  Comparison to(memory);
  compare_skip_map(to, registers, data.field);
  compare_bricks(to, "levels", memory.levels, data.field, data.field.levels, static_cast<std::int16_t>(kAir));
  compare_bricks(to, "matter", memory.matter, data.field, data.field.matter, std::uint32_t{0});
  compare_light(to, memory, data.light);
  if (data.ground.any) {
    compare_ground(to, memory, data.ground);
    compare_bounds(to, registers.ground.blocks, data.ground);
  }
  return to.found;
}

std::string text_of(const UploadDifference& difference, std::int64_t step) {
  return fmt::format("step {}: {} at {}, {}, {} (brick {}, {}, {}): expected {}, got {}\n", step,
                     difference.volume, difference.place.x, difference.place.y, difference.place.z,
                     difference.brick.x, difference.brick.y, difference.brick.z, difference.expected,
                     difference.actual);
}

}  // namespace voxmelt::hwmodel::raycast
