#include "render/light/light_matter.h"

#include <algorithm>
#include <cstring>

#include "render/rule/clear.h"
#include "render/rule/fixed_point.h"
#include "render/rule/matter.h"

namespace voxmelt::render {
namespace {

constexpr std::int32_t kHeight = 4096;  // height of a cell, in units of column heights

// Returns the emission of liquid that fills its cell, by the temperature in 256 steps.
std::array<std::uint16_t, 257> emission_by_temperature(const picture::Look& look) {
  std::array<std::uint16_t, 257> values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int32_t heat = picture::matter_of(0, 256, static_cast<std::int32_t>(i), 0, look).heat;
    values[i] = static_cast<std::uint16_t>((heat * heat) >> 8);
  }
  return values;
}

// Returns the thinned density of matter that is no obstacle, by its own density.
std::array<std::uint8_t, 256> thinned_densities(const picture::Look& look, int shift) {
  std::array<std::uint8_t, 256> values;
  const std::int32_t share =
      picture::is_clear(look)
          ? picture::density_share(picture::passing_table(), picture::losses_of(look.clear), shift)
          : 256;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::uint8_t>(picture::thinned(static_cast<std::int32_t>(i), share));
  return values;
}

}  // namespace

bool LightSources::update(const DensityField& field, const std::vector<std::int32_t>& ground,
                          const picture::Look& look, const std::vector<std::uint32_t>* refreshed,
                          const LightLoops& loops) {
  const state::Grid& grid = field.grid();
  const picture::Vector cells{grid.x, grid.y, grid.z};
  const std::array<std::uint8_t, 256> thinned = thinned_densities(look, picture::light_shift(cells));
  const bool other = !(grid == grid_) || look.glow != glow_ || thinned != thinned_;
  if (other) {
    grid_ = grid;
    glow_ = look.glow;
    clear_ = picture::is_clear(look);
    thinned_ = thinned;
    shift_ = picture::light_shift(cells);
    matter_ = {{picture::light_cells(cells), 0}, {}};
    if (glow_) matter_.emission = matter_.density;
    own_.assign(matter_.density.cells.size(), 0);
    earth_ = own_;
    ground_.clear();
    const auto blocks = [&](int side) { return (side - 1) / std::max(kBrickSide, 1 << shift_) + 1; };
    blocks_ = {blocks(grid.x), blocks(grid.y), blocks(grid.z)};
    listed_.assign(blocks_.cells(), 0);
  }
  const Emission emission = glow_ ? emission_by_temperature(look) : Emission{};
  const bool other_emission = emission != emission_of_;
  emission_of_ = emission;
  find_blocks(field, other || other_emission ? nullptr : refreshed);
  bool changed = false;
  for (const std::uint32_t block : list_) changed = refresh_block(field, block, loops) || changed;
  return refresh_ground(ground) || changed;
}

void LightSources::find_blocks(const DensityField& field, const std::vector<std::uint32_t>* refreshed) {
  list_.clear();
  if (refreshed == nullptr) {
    for (std::size_t block = 0; block < blocks_.cells(); ++block)
      list_.push_back(static_cast<std::uint32_t>(block));
    return;
  }
  const int finer = std::max(shift_ - 3, 0);
  if (finer == 0) {
    list_ = *refreshed;
    return;
  }
  const auto x = static_cast<std::uint32_t>(field.bricks().x),
             y = static_cast<std::uint32_t>(field.bricks().y);
  for (const std::uint32_t brick : *refreshed) {
    const std::size_t block =
        blocks_.index(static_cast<int>(brick % x) >> finer, static_cast<int>(brick / x % y) >> finer,
                      static_cast<int>(brick / x / y) >> finer);
    if (listed_[block] == 0) list_.push_back(static_cast<std::uint32_t>(block));
    listed_[block] = 1;
  }
  for (const std::uint32_t block : list_) listed_[block] = 0;
}

bool LightSources::refresh_block(const DensityField& field, std::uint32_t block, const LightLoops& loops) {
  const int side = std::max(kBrickSide, 1 << shift_), cells = side >> shift_;
  const int i = block;
  const state::Grid at{i % blocks_.x, i / blocks_.x % blocks_.y, i / blocks_.x / blocks_.y};
  const state::Grid first{at.x * side, at.y * side, at.z * side};
  const auto count = [&](int from, int number) { return std::min(side, number - from); };
  const std::size_t cell = grid_.index(first.x, first.y, first.z);
  const std::size_t room = cells;
  LightBlock from{count(first.x, grid_.x),
                  count(first.y, grid_.y),
                  count(first.z, grid_.z),
                  grid_.index(0, 1, 0),
                  grid_.index(0, 0, 1),
                  field.intensity().data() + cell,
                  field.liquid().data() + cell,
                  field.heat().data() + cell,
                  emission_of_.data(),
                  shift_,
                  room,
                  room * room};
  std::array<std::uint8_t, 64> own{}, light{};
  loops.density(from, own.data());
  if (glow_) loops.emission(from, light.data());
  if (clear_) {
    std::array<std::uint8_t, 64> obstacle{};
    if (field.has_obstacles()) {
      from.intensity = field.obstacle().data() + cell;
      loops.density(from, obstacle.data());
    }
    for (std::size_t c = 0; c < own.size(); ++c) own[c] = thinned_density(own[c], obstacle[c]);
  }
  const auto ends = [&](int n) { return static_cast<std::size_t>((n - 1) >> shift_) + 1; };
  bool changed = false;
  for (std::size_t z = 0; z < ends(from.z); ++z)
    for (std::size_t y = 0; y < ends(from.y); ++y) {
      const std::size_t to = matter_.density.index(at.x * cells, at.y * cells + static_cast<int>(y),
                                                   at.z * cells + static_cast<int>(z)),
                        row = (z * room + y) * room, wide = ends(from.x);
      if (glow_ && std::memcmp(matter_.emission.cells.data() + to, light.data() + row, wide) != 0) {
        std::memcpy(matter_.emission.cells.data() + to, light.data() + row, wide);
        changed = true;
      }
      if (std::memcmp(own_.data() + to, own.data() + row, wide) == 0) continue;
      std::memcpy(own_.data() + to, own.data() + row, wide);
      for (std::size_t x = 0; x < wide; ++x) changed = show(to + x) || changed;
    }
  return changed;
}

// Thins all but the obstacles, which are not clear.
std::uint8_t LightSources::thinned_density(std::uint8_t all, std::uint8_t obstacle) const {
  const int opaque = std::min(all, obstacle);
  return static_cast<std::uint8_t>(opaque + thinned_[all - opaque]);
}

bool LightSources::show(std::size_t cell) {
  const std::uint8_t density = std::max(own_[cell], earth_[cell]);
  if (density == matter_.density.cells[cell]) return false;
  matter_.density.cells[cell] = density;
  return true;
}

// Takes over columns whose height has changed.
bool LightSources::refresh_ground(const std::vector<std::int32_t>& ground) {
  if (ground == ground_) return false;
  const std::size_t columns = static_cast<std::size_t>(grid_.x) * grid_.z;
  ground_.resize(columns, 0);
  std::vector<std::int32_t> none;
  if (ground.empty()) none.assign(columns, 0);
  const std::vector<std::int32_t>& fresh = ground.empty() ? none : ground;
  bool changed = false;
  const std::size_t x = grid_.x;
  for (std::int64_t lz = 0; lz < matter_.density.count.z; ++lz) {
    const auto end = std::min<std::size_t>(static_cast<std::size_t>((lz + 1) << shift_),
                                           static_cast<std::size_t>(grid_.z));
    std::int64_t done = -1;  // the last column of light that was refreshed
    for (std::size_t z = lz << shift_; z < end; ++z) {
      if (std::memcmp(ground_.data() + z * x, fresh.data() + z * x, x * sizeof(std::int32_t)) == 0) continue;
      done = -1;
      for (std::size_t i = 0; i < x; ++i) {
        const std::int64_t lx = i >> shift_;
        if (ground_[z * x + i] == fresh[z * x + i] || lx == done) continue;
        changed = refresh_earth(lx, lz, fresh) || changed;
        done = lx;
      }
    }
  }
  ground_ = ground;
  return changed;
}

// Takes over the cells of light in a column of them, from the lowest height that was or is in it to the
// highest.
bool LightSources::refresh_earth(std::int64_t x, std::int64_t z, const std::vector<std::int32_t>& ground) {
  const auto end = [&](std::int64_t i, int side) { return std::min<std::int64_t>((i + 1) << shift_, side); };
  const std::int64_t height = std::int64_t{kHeight} << shift_;
  const auto each = [&](const auto& visit) {
    for (std::int64_t k = z << shift_; k < end(z, grid_.z); ++k)
      for (std::int64_t i = x << shift_; i < end(x, grid_.x); ++i)
        visit(static_cast<std::size_t>(k) * grid_.x + i);
  };
  const std::int64_t most = matter_.density.count.y * height;
  std::int64_t low = most, high = 0;
  each([&](std::size_t i) {
    low = std::min<std::int64_t>({low, ground_[i], ground[i]});
    high = std::max<std::int64_t>({high, ground_[i], ground[i]});
  });
  bool changed = false;
  const std::int64_t last = std::min(matter_.density.count.y - 1, high / height);
  for (std::int64_t y = std::max<std::int64_t>(low, 0) / height; y <= last; ++y) {
    std::int64_t earth = 0;
    each([&](std::size_t i) { earth += std::clamp<std::int64_t>(ground[i] - y * height, 0, height); });
    const std::size_t cell = matter_.density.index(x, y, z);
    earth_[cell] = static_cast<std::uint8_t>((earth * 255) >> (3 * shift_ + 12));
    changed = show(cell) || changed;
  }
  return changed;
}

}  // namespace voxmelt::render
