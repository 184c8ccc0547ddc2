#include "hwmodel/caster/host/memory_image.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "hwmodel/caster/model/shade.h"
#include "render/ground/ground_map.h"
#include "render/packet/field_bricks.h"

namespace voxmelt::hwmodel::raycast {
namespace {

int whole_bursts(int bytes) { return (bytes + kBurst - 1) / kBurst * kBurst; }

// Places the lines of a volume behind all that has room.
void take_room(Memory& memory, Layout& layout, std::int64_t lines) {
  memory.bytes.resize((memory.bytes.size() + kBurst - 1) / kBurst * kBurst);
  layout.base = memory.bytes.size();
  memory.bytes.resize(layout.address(lines));
}

Layout brick_layout(const render::FieldData& field, int word_bytes, int bits, bool apron) {
  const state::Grid bricks = lattice_bricks(field);
  Layout layout;
  layout.sparse = true;
  layout.apron = apron;
  layout.word_bytes = word_bytes;
  const int side = apron ? kBrickBits : bits;  // with its apron a brick is a line
  layout.bits = {side, side, side};
  layout.count = {bricks.x, bricks.y, bricks.z};
  layout.slots.assign(field.slots, field.slots + bricks.cells());
  layout.line_bytes = whole_bursts((apron ? render::kBrickVolume : 1 << (3 * bits)) * word_bytes);
  return layout;
}
std::int64_t lines_of_brick(const Layout& layout) {
  return layout.apron ? 1 : std::int64_t{1} << (3 * (kBrickBits - layout.bits[0]));
}

Layout dense_layout(std::array<int, 3> count, std::array<int, 3> bits, int word_bytes) {
  Layout layout;
  layout.word_bytes = word_bytes;
  layout.bits = bits;
  for (std::size_t axis = 0; axis < 3; ++axis) layout.count[axis] = ((count[axis] - 1) >> bits[axis]) + 1;
  layout.line_bytes = whole_bursts(word_bytes << (bits[0] + bits[1] + bits[2]));
  return layout;
}
std::int64_t lines_of(const Layout& layout) {
  return std::int64_t{layout.count[0]} * layout.count[1] * layout.count[2];
}

std::array<int, 3> light_count(const render::PictureData& data) {
  const picture::Vector& count = data.light.count;
  return {static_cast<int>(count.x), static_cast<int>(count.y), static_cast<int>(count.z)};
}
std::array<int, 3> column_count(const render::PictureData& data) {
  return {static_cast<int>(data.ground.cells.x), 1, static_cast<int>(data.ground.cells.z)};
}
std::array<int, 3> texel_count(const render::PictureData& data) {
  const std::array<int, 3> columns = column_count(data);
  const int q = data.ground.fineness;
  return {columns[0] << q, 1, columns[2] << q};
}

// Lays out the lines of a brick, from the software's bricks with their aprons.
template <class Word>
void brick_lines(const Layout& layout, const state::Grid& at, const Word* from, const LineSink& sink) {
  const std::int64_t slot = layout.brick_at(at.x, at.y, at.z);
  const Word* brick = from + slot * render::kBrickVolume;
  std::vector<std::uint8_t> bytes(layout.line_bytes);
  if (layout.apron) {
    std::memcpy(bytes.data(), brick, sizeof(Word) * render::kBrickVolume);
    return sink(slot, bytes.data());
  }
  const int bits = layout.bits[0], side = 1 << bits;
  for (int lz = 0; lz < 8; lz += side)
    for (int ly = 0; ly < 8; ly += side)
      for (int lx = 0; lx < 8; lx += side) {
        for (int z = lz; z < lz + side; ++z)
          for (int y = ly; y < ly + side; ++y)
            for (int x = lx; x < lx + side; ++x)
              std::memcpy(bytes.data() + layout.offset(x, y, z),
                          brick + ((z + 1) * kApronSide + y + 1) * kApronSide + x + 1, sizeof(Word));
        sink(layout.line_at((8 * at.x + lx) >> bits, (8 * at.y + ly) >> bits, (8 * at.z + lz) >> bits),
             bytes.data());
      }
}

// Lays out the lines of a box of `count` places, with the words at(x, y, z).
template <class Word, class At>
void dense_lines(const Layout& layout, std::array<int, 3> count, const LineSink& sink, const At& at) {
  std::vector<std::uint8_t> bytes(layout.line_bytes);
  const auto end = [&](int line, std::size_t axis) {
    return std::min((line + 1) << layout.bits[axis], count[axis]);
  };
  for (int lz = 0; lz < layout.count[2]; ++lz)
    for (int ly = 0; ly < layout.count[1]; ++ly)
      for (int lx = 0; lx < layout.count[0]; ++lx) {
        std::fill(bytes.begin(), bytes.end(), 0);
        for (int z = lz << layout.bits[2]; z < end(lz, 2); ++z)
          for (int y = ly << layout.bits[1]; y < end(ly, 1); ++y)
            for (int x = lx << layout.bits[0]; x < end(lx, 0); ++x) {
              const Word word = at(x, y, z);
              std::memcpy(bytes.data() + layout.offset(x, y, z), &word, sizeof word);
            }
        sink(layout.line_at(lx, ly, lz), bytes.data());
      }
}

}  // namespace

state::Grid lattice_bricks(const render::FieldData& field) {
  const auto bricks = [](std::int64_t side) { return static_cast<int>((side + 2) / 8 + 1); };
  return {bricks(field.cells.x), bricks(field.cells.y), bricks(field.cells.z)};
}

std::int64_t stored_bricks(const render::FieldData& field) {
  return *std::max_element(field.slots, field.slots + lattice_bricks(field).cells()) + std::int64_t{1};
}

Memory room_for(const render::PictureData& data, const Configuration& configuration, std::int64_t bricks) {
  Memory memory;
  const auto room = [&](Layout& layout, std::int64_t lines) { take_room(memory, layout, lines); };
  memory.levels =
      brick_layout(data.field, sizeof(std::int16_t), configuration.level_bits, configuration.apron);
  room(memory.levels, bricks * lines_of_brick(memory.levels));
  memory.matter = brick_layout(data.field, sizeof(std::uint32_t), 2, false);
  room(memory.matter, bricks * lines_of_brick(memory.matter));
  memory.light = dense_layout(light_count(data), {1, 1, 1}, sizeof(LightWord));
  room(memory.light, lines_of(memory.light));
  if (data.ground.any) {
    memory.heights = dense_layout(column_count(data), {2, 0, 2}, sizeof(Column));
    room(memory.heights, lines_of(memory.heights));
    if (!data.ground.map->texels().empty()) {
      memory.texels = dense_layout(texel_count(data), {2, 0, 2}, sizeof(Texel));
      room(memory.texels, lines_of(memory.texels));
    }
  }
  Layout frame;
  take_room(memory, frame, 0);
  memory.frame = frame.base;
  memory.bytes.resize(memory.bytes.size() + 2 * frame_bytes(data.width, data.height));
  return memory;
}

void level_lines(const render::PictureData& data, const Layout& layout, const state::Grid& brick,
                 const LineSink& sink) {
  brick_lines(layout, brick, data.field.levels, sink);
}
void matter_lines(const render::PictureData& data, const Layout& layout, const state::Grid& brick,
                  const LineSink& sink) {
  brick_lines(layout, brick, data.field.matter, sink);
}

void light_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink) {
  const picture::Vector& count = data.light.count;
  dense_lines<LightWord>(layout, light_count(data), sink, [&](int x, int y, int z) {
    LightWord word;
    std::memcpy(word.data(), data.light.cells + 16 * ((z * count.y + y) * count.x + x), sizeof word);
    return word;
  });
}
void height_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink) {
  const render::GroundData& ground = data.ground;
  if (!ground.any) return;
  dense_lines<Column>(layout, column_count(data), sink, [&](int x, int, int z) {
    const std::ptrdiff_t i = std::ptrdiff_t{z} * ground.row + x;
    return Column{ground.drawn[i], ground.bare[i]};
  });
}
void texel_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink) {
  if (!data.ground.any || data.ground.map->texels().empty()) return;
  const std::vector<picture::Texel>& texels = data.ground.map->texels();
  const std::array<int, 3> count = texel_count(data);
  const std::size_t row = count[0];
  dense_lines<Texel>(layout, count, sink, [&](int x, int, int z) {
    const picture::Texel& t = texels[z * row + x];
    return Texel{t.red, t.green, t.blue, t.bump_x, t.bump_z};
  });
}

}  // namespace voxmelt::hwmodel::raycast
