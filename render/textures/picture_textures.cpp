#include "render/textures/picture_textures.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "render/density/brick.h"
#include "render/packet/field_bricks.h"
#include "render/rule/normal.h"

namespace voxmelt::render {
namespace {

using picture::Vector;

constexpr int kTableRow = 1024;  // numbers in a row of the tables
constexpr int kBrickCells = kBrickSide * kBrickSide * kBrickSide;
constexpr BrickedTexture::Side kCube{kBrickSide, kBrickSide, kBrickSide}, kTile{16, 16, 1};

std::uint64_t next_version() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::int32_t whole(std::int64_t value) { return static_cast<std::int32_t>(value); }
std::vector<std::int32_t> list_of(const Vector& v) { return {whole(v.x), whole(v.y), whole(v.z)}; }
std::vector<std::int32_t> list_of(const picture::Color& c) { return {c.begin(), c.end()}; }
std::vector<std::int32_t> list_of(const picture::Material& m) {
  std::vector<std::int32_t> list;
  for (const picture::Color* color : {&m.diffuse, &m.mirror, &m.highlight})
    list.insert(list.end(), color->begin(), color->end());
  list.push_back(m.gloss);
  return list;
}

// Returns the numbers of the paint, by the names that docs/picture gives them.
std::vector<PictureNumbers> numbers_of(const PictureData& data) {
  const picture::Paint& paint = *data.paint;
  const GroundData& ground = data.ground;
  const auto flag = [](bool value) { return std::vector<std::int32_t>{value ? 1 : 0}; };
  return {{"cells", list_of(data.field.cells)},
          {"light_cells", list_of(data.light.count)},
          {"light_shift", {data.light.shift}},
          {"obstacles", flag(data.field.obstacles)},
          {"background", list_of(data.background)},
          {"to_light", list_of(paint.to_light)},
          {"to_strip", list_of(paint.to_strip)},
          {"lamp", list_of(paint.lamp)},
          {"from_below", list_of(paint.from_below)},
          {"from_above", list_of(paint.from_above)},
          {"solid", list_of(paint.solid)},
          {"liquid", list_of(paint.liquid)},
          {"obstacle", list_of(paint.obstacle)},
          {"glow", flag(paint.glow)},
          {"clear", flag(paint.clear)},
          {"tinted", flag(paint.tinted)},
          {"losses", list_of(paint.losses)},
          {"frost", {paint.frost}},
          {"lamp_range", {paint.lamp_low, paint.lamp_high}},
          {"strip_range", {paint.strip_low, picture::kStripHigh}},
          {"ground", flag(ground.any)},
          {"rock", flag(ground.texels != nullptr)},
          {"highest", {ground.highest}},
          {"slopes", {whole(ground.slopes.x), whole(ground.slopes.z)}},
          {"ground_color", {ground.color[0], ground.color[1], ground.color[2]}},
          {"fineness", {ground.fineness}},
          {"band_count", {ground.band_count}}};
}

// Puts tables behind each other, and notes where each begins.
class Tables {
 public:
  Tables(std::vector<std::int32_t>& all, std::vector<PictureNumbers>& numbers)
      : all_(all), numbers_(numbers) {}

  template <class Table>
  void add(std::string_view name, const Table& table) {
    numbers_.push_back({name, {whole(static_cast<std::int64_t>(all_.size()))}});
    for (const auto& entry : table) append(entry);
  }

 private:
  template <class Number>
  void append(Number number) {
    all_.push_back(static_cast<std::int32_t>(number));
  }
  void append(const picture::Color& color) { all_.insert(all_.end(), color.begin(), color.end()); }
  void append(const picture::Material& material) {
    for (const std::int32_t number : list_of(material)) all_.push_back(number);
  }

  std::vector<std::int32_t>& all_;
  std::vector<PictureNumbers>& numbers_;
};

}  // namespace

void PictureTextures::update(const PictureData& data) {
  begin(data);
  const std::uint64_t version = next_version();
  bool changed = version_ == 0;
  changed = take_field(data.field, version) || changed;
  changed = take_blocks(data.field, version) || changed;
  const auto cells = [](std::int64_t count) { return static_cast<int>(count); };
  const Vector light = data.light.count;
  changed =
      all_[kLight].write_all(data.light.cells, {cells(light.x), cells(light.y), cells(light.z)}, version) ||
      changed;
  const std::vector<PictureNumbers> before = std::exchange(numbers_, {});
  changed = take_tables(data, version) || changed;
  changed = take_ground(data.ground, version) || changed;
  const auto same = [](const PictureNumbers& a, const PictureNumbers& b) { return a.values == b.values; };
  changed = changed || !std::equal(before.begin(), before.end(), numbers_.begin(), numbers_.end(), same);
  if (changed) version_ = version;
}

// Makes the textures, if there are none of these sizes.
void PictureTextures::begin(const PictureData& data) {
  const int x = data.field.bricks_x, y = data.field.bricks_y,
            z = whole((data.field.cells.z + 2) / kBrickSide) + 1;
  const std::vector<std::int32_t> cells = list_of(data.field.cells), light = list_of(data.light.count);
  const bool rock = data.ground.texels != nullptr;
  std::vector<std::int32_t> shape = cells;
  shape.insert(shape.end(), light.begin(), light.end());
  shape.insert(shape.end(), {rock ? 1 : 0, data.ground.fineness});
  if (shape == shape_) return;
  shape_ = std::move(shape);
  version_ = 0;
  first_ = next_version();
  const int texels = rock ? 1 << data.ground.fineness : 0;
  const BrickedTexture::Side places{x * kBrickSide, y * kBrickSide, z * kBrickSide};
  all_.clear();
  all_.emplace_back("levels", Texel::u16, places, kCube);
  all_.emplace_back("matter", Texel::u8x4, places, kCube);
  all_.emplace_back("blocks", Texel::u16, BrickedTexture::Side{2 * x, 2 * y, 2 * z}, kCube);
  all_.emplace_back("light", Texel::u32x4, BrickedTexture::Side{light[0], light[1], light[2]},
                    BrickedTexture::Side{4, 4, 4});
  all_.emplace_back("columns", Texel::i32x2, BrickedTexture::Side{cells[0], cells[2], 1}, kTile);
  all_.emplace_back("rock", Texel::u32x2, BrickedTexture::Side{cells[0] * texels, cells[2] * texels, 1},
                    kTile);
  constexpr int kTableRows = 40;
  all_.emplace_back("tables", Texel::i32, BrickedTexture::Side{kTableRow, kTableRows, 1},
                    BrickedTexture::Side{kTableRow, 1, 1});
}

// A brick of the lattice holds a place more before its own eight, and two behind.
bool PictureTextures::take_field(const FieldData& field, std::uint64_t version) {
  std::array<std::uint16_t, kBrickCells> levels{};
  std::array<std::uint32_t, kBrickCells> matter{};
  bool changed = false;
  for (std::size_t brick = 0; brick < all_[kLevels].count(); ++brick) {
    const auto slot = static_cast<std::size_t>(field.slots[brick]);
    if (slot == 0) {
      if (all_[kLevels].version(brick) + all_[kMatter].version(brick) == 0) continue;
      levels.fill(0);
      matter.fill(0);
    } else {
      std::size_t to = 0;
      for (int z = 1; z <= kBrickSide; ++z)
        for (int y = 1; y <= kBrickSide; ++y, to += kBrickSide) {
          const std::size_t from =
              slot * kBrickVolume + static_cast<std::size_t>((z * kBrickPlaces + y) * kBrickPlaces + 1);
          for (std::size_t i = 0; i < kBrickSide; ++i)
            levels[to + i] = static_cast<std::uint16_t>(field.levels[from + i] - picture::kAir);
          std::memcpy(matter.data() + to, field.matter + from, kBrickSide * sizeof(std::uint32_t));
        }
    }
    changed = all_[kLevels].write(brick, levels.data(), version) || changed;
    changed = all_[kMatter].write(brick, matter.data(), version) || changed;
  }
  return changed;
}

bool PictureTextures::take_blocks(const FieldData& field, std::uint64_t version) {
  constexpr std::uint16_t kOccupied = 256;
  const int z = static_cast<int>(all_[kLevels].bricks()[2]) * 2;
  std::vector<std::uint16_t> blocks(static_cast<std::size_t>(field.blocks_x) * field.blocks_y * z);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    blocks[i] = static_cast<std::uint16_t>((field.records[i] & 255) | (field.records[i] < 0 ? 0 : kOccupied));
  return all_[kBlocks].write_all(blocks.data(), {field.blocks_x, field.blocks_y, z}, version);
}

bool PictureTextures::take_ground(const GroundData& ground, std::uint64_t version) {
  if (!ground.any) return false;
  const int x = whole(ground.cells.x), z = whole(ground.cells.z);
  std::vector<std::int32_t> columns;
  columns.reserve(2 * static_cast<std::size_t>(x) * z);
  for (int k = 0; k < z; ++k)
    for (int i = 0; i < x; ++i) {
      const std::ptrdiff_t at = std::ptrdiff_t{k} * ground.row + i;
      columns.push_back(ground.bare[at]);
      columns.push_back(ground.drawn[at]);
    }
  const bool changed = all_[kColumns].write_all(columns.data(), {x, z, 1}, version);
  if (ground.texels == nullptr) return changed;
  const int fineness = ground.fineness;
  return all_[kRock].write_all(ground.texels, {x << fineness, z << fineness, 1}, version) || changed;
}

bool PictureTextures::take_tables(const PictureData& data, std::uint64_t version) {
  const picture::Paint& paint = *data.paint;
  const GroundData& ground = data.ground;
  numbers_ = numbers_of(data);
  tables_.clear();
  Tables tables(tables_, numbers_);
  tables.add("at_roots", picture::kInverseRoot);
  tables.add("at_bytes", *data.bytes);
  tables.add("at_tone", *data.tone);
  tables.add("at_highlight", paint.highlight);
  tables.add("at_dull_highlight", paint.dull_highlight);
  tables.add("at_surroundings", paint.surroundings);
  tables.add("at_glow", paint.glow_colors.light);
  tables.add("at_crust", paint.glow_colors.crust);
  tables.add("at_tints", paint.tints);
  tables.add("at_passing", paint.passing);
  if (ground.texels != nullptr) {
    tables.add("at_bands", std::span(ground.bands, static_cast<std::size_t>(ground.band_count)));
    const auto along = [](std::int64_t count) { return static_cast<std::size_t>(count); };
    tables.add("at_low_x", std::span(ground.bends[0], along(ground.cells.z)));
    tables.add("at_high_x", std::span(ground.bends[1], along(ground.cells.z)));
    tables.add("at_low_z", std::span(ground.bends[2], along(ground.cells.x)));
    tables.add("at_high_z", std::span(ground.bends[3], along(ground.cells.x)));
  }
  const int rows = (whole(static_cast<std::int64_t>(tables_.size())) + kTableRow - 1) / kTableRow;
  tables_.resize(static_cast<std::size_t>(rows) * kTableRow, 0);
  return all_[kTables].write_all(tables_.data(), {kTableRow, rows, 1}, version);
}

}  // namespace voxmelt::render
