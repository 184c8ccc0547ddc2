#include "hwmodel/picture/upload.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "hwmodel/raycast/ground.h"
#include "hwmodel/raycast/ray_caster.h"
#include "hwmodel/raycast/shade.h"
#include "render/ground/ground_map.h"
#include "render/packet/field_bricks.h"

namespace voxmelt::hwmodel::raycast {
namespace {

Vec vec_of(const picture::Vector& v) { return {v.x, v.y, v.z}; }

Material material_of(const picture::Material& of) { return {of.diffuse, of.mirror, of.highlight, of.gloss}; }

CameraRegisters camera_of(const render::PictureData& data) {
  const picture::View& view = data.view;
  CameraRegisters of;
  of.eye = vec_of(view.eye), of.forward = vec_of(view.forward);
  of.wide = vec_of(view.wide), of.high = vec_of(view.high);
  of.near_wide = vec_of(view.near_wide), of.near_high = vec_of(view.near_high);
  of.near = view.near;
  of.width = data.width, of.height = data.height;
  of.spacing = data.spacing, of.halvings = view.halvings;
  return of;
}

LookRegisters look_of(const render::PictureData& data) {
  const picture::Paint& paint = *data.paint;
  LookRegisters of;
  of.to_light = vec_of(paint.to_light), of.to_strip = vec_of(paint.to_strip);
  of.lamp = paint.lamp, of.from_below = paint.from_below, of.from_above = paint.from_above;
  of.background = data.background;
  of.solid = material_of(paint.solid), of.liquid = material_of(paint.liquid);
  of.obstacle = material_of(paint.obstacle);
  of.glow = paint.glow, of.obstacles = data.field.obstacles;
  of.lamp_low = paint.lamp_low, of.lamp_high = paint.lamp_high, of.strip_low = paint.strip_low;
  of.highlight = paint.highlight, of.dull_highlight = paint.dull_highlight;
  of.surroundings = paint.surroundings;
  of.glow_light = paint.glow_colors.light, of.glow_crust = paint.glow_colors.crust;
  of.tone.assign(data.tone->begin(), data.tone->end());
  of.bytes.assign(data.bytes->begin(), data.bytes->end());
  return of;
}

GroundRegisters ground_of(const render::PictureData& data) {
  const render::GroundMap* map = data.ground.map;
  GroundRegisters of;
  of.any = data.ground.any;
  if (!of.any) return of;
  of.highest = map->highest();
  of.slopes = vec_of(map->slopes());
  for (std::size_t c = 0; c < 3; ++c) of.color[c] = data.ground.color[c];
  of.textured = !map->texels().empty();
  of.fineness = map->fineness();
  of.bands.assign(map->bands().begin(), map->bands().end());
  of.bends = map->bends();
  return of;
}

state::Grid lattice_bricks(const render::FieldData& field) {
  const auto bricks = [](std::int64_t side) { return static_cast<int>((side + 2) / 8 + 1); };
  return {bricks(field.cells.x), bricks(field.cells.y), bricks(field.cells.z)};
}

SkipMap skip_of(const render::FieldData& field) {
  const state::Grid bricks = lattice_bricks(field);
  SkipMap of;
  of.x = 2 * bricks.x, of.y = 2 * bricks.y, of.z = 2 * bricks.z;
  of.words.resize(static_cast<std::size_t>(of.x) * static_cast<std::size_t>(of.y) *
                  static_cast<std::size_t>(of.z));
  for (std::size_t i = 0; i < of.words.size(); ++i) {
    const std::int32_t record = field.records[i];
    of.words[i] = static_cast<std::uint16_t>((record & 255) + (record < 0 ? 256 : 0));
  }
  of.low = to_lattice(vec_of(field.low)), of.high = to_lattice(vec_of(field.high));
  return of;
}

// Appends to a memory, line by line.
class Writer {
 public:
  explicit Writer(Memory& memory) : memory_(memory) {}
  // The lines of a layout begin here.
  void begin(Layout& layout) {
    memory_.bytes.resize((memory_.bytes.size() + kBurst - 1) / kBurst * kBurst);
    layout.base = static_cast<std::int64_t>(memory_.bytes.size());
  }
  void room(const Layout& layout, std::int64_t lines) {
    memory_.bytes.resize(static_cast<std::size_t>(layout.base + lines * layout.line_bytes));
  }
  template <class Word>
  void put(const Layout& layout, std::int64_t line, int offset, const Word& word) {
    std::memcpy(memory_.bytes.data() + layout.address(line) + offset, &word, sizeof word);
  }

 private:
  Memory& memory_;
};

int line_bytes_of(int bytes) { return (bytes + kBurst - 1) / kBurst * kBurst; }

// Levels or matter, from the software's bricks with their aprons.
template <class Word>
Layout write_bricks(Writer& writer, const render::FieldData& field, const Word* from, int bits, bool apron) {
  const state::Grid bricks = lattice_bricks(field);
  if (apron) bits = kBrickBits;
  Layout of;
  of.sparse = true;
  of.apron = apron;
  of.word_bytes = sizeof(Word);
  of.bits = {bits, bits, bits};
  of.count = {bricks.x, bricks.y, bricks.z};
  of.slots.assign(field.slots, field.slots + bricks.cells());
  of.line_bytes =
      line_bytes_of((apron ? render::kBrickVolume : 1 << (3 * bits)) * static_cast<int>(sizeof(Word)));
  writer.begin(of);
  const std::int64_t stored = *std::max_element(of.slots.begin(), of.slots.end()) + std::int64_t{1};
  const std::int64_t lines_of_brick = apron ? 1 : std::int64_t{1} << (3 * (kBrickBits - bits));
  writer.room(of, stored * lines_of_brick);
  for (int bz = 0; bz < bricks.z; ++bz)
    for (int by = 0; by < bricks.y; ++by)
      for (int bx = 0; bx < bricks.x; ++bx) {
        const std::int64_t slot = of.brick_at(bx, by, bz);
        if (slot == 0) continue;
        const Word* brick = from + slot * render::kBrickVolume;
        if (apron) {
          for (int i = 0; i < render::kBrickVolume; ++i)
            writer.put(of, slot, i * static_cast<int>(sizeof(Word)), brick[i]);
          continue;
        }
        for (int z = 0; z < 8; ++z)
          for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
              const int px = 8 * bx + x, py = 8 * by + y, pz = 8 * bz + z;
              writer.put(of, of.line_at(px >> bits, py >> bits, pz >> bits), of.offset(px, py, pz),
                         brick[((z + 1) * kApronSide + y + 1) * kApronSide + x + 1]);
            }
      }
  return of;
}

// Words at(x, y, z) of a box of so many places.
template <class Word, class At>
Layout write_dense(Writer& writer, std::array<int, 3> count, std::array<int, 3> bits, const At& at) {
  Layout of;
  of.word_bytes = sizeof(Word);
  of.bits = bits;
  for (std::size_t axis = 0; axis < 3; ++axis) of.count[axis] = ((count[axis] - 1) >> bits[axis]) + 1;
  of.line_bytes = line_bytes_of(static_cast<int>(sizeof(Word)) << (bits[0] + bits[1] + bits[2]));
  writer.begin(of);
  writer.room(of, std::int64_t{of.count[0]} * of.count[1] * of.count[2]);
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) {
        const Word word = at(x, y, z);
        writer.put(of, of.line_at(x >> bits[0], y >> bits[1], z >> bits[2]), of.offset(x, y, z), word);
      }
  return of;
}

}  // namespace

Registers registers_of(const render::PictureData& data) {
  Registers of;
  of.cells = vec_of(data.field.cells);
  of.camera = camera_of(data);
  of.look = look_of(data);
  of.ground = ground_of(data);
  of.skip = skip_of(data.field);
  of.light_cells = vec_of(data.light.count);
  of.light_shift = data.light.shift;
  return of;
}

Memory memory_of(const render::PictureData& data, const Configuration& configuration) {
  Memory memory;
  Writer writer(memory);
  const render::FieldData& field = data.field;
  memory.levels = write_bricks(writer, field, field.levels, configuration.level_bits, configuration.apron);
  memory.matter = write_bricks(writer, field, field.matter, 2, false);

  const picture::Vector& count = data.light.count;
  const std::array<int, 3> cells{static_cast<int>(count.x), static_cast<int>(count.y),
                                 static_cast<int>(count.z)};
  memory.light = write_dense<LightWord>(writer, cells, {1, 1, 1}, [&](int x, int y, int z) {
    LightWord word;
    std::memcpy(word.data(), data.light.cells + 16 * ((z * count.y + y) * count.x + x), sizeof word);
    return word;
  });
  if (data.ground.any) {
    const render::GroundData& ground = data.ground;
    const auto nx = static_cast<int>(ground.cells.x), nz = static_cast<int>(ground.cells.z);
    memory.heights = write_dense<Column>(writer, {nx, 1, nz}, {2, 0, 2}, [&](int x, int, int z) {
      const std::ptrdiff_t i = std::ptrdiff_t{z} * ground.row + x;
      return Column{ground.drawn[i], ground.bare[i]};
    });
    const std::vector<picture::Texel>& texels = ground.map->texels();
    const int q = ground.fineness;
    if (!texels.empty())
      memory.texels = write_dense<Texel>(writer, {nx << q, 1, nz << q}, {2, 0, 2}, [&](int x, int, int z) {
        const picture::Texel& t = texels[static_cast<std::size_t>(z) * static_cast<std::size_t>(nx << q) +
                                         static_cast<std::size_t>(x)];
        return Texel{t.red, t.green, t.blue, t.bump_x, t.bump_z};
      });
  }
  Layout frame;
  writer.begin(frame);
  memory.frame = frame.base;
  memory.bytes.resize(memory.bytes.size() +
                      2 * static_cast<std::size_t>(frame_bytes(data.width, data.height)));
  return memory;
}

}  // namespace voxmelt::hwmodel::raycast
