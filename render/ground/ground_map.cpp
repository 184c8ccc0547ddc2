#include "render/ground/ground_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/ground/watched_ground.h"

namespace voxmelt::render {
namespace {

using picture::Face;
using picture::kHeight;
using picture::Vector;

// Rounds to nearest, with halves upwards. `one` is a power of 2. The sum of `exact` and 1/2 could round, so
// it is avoided.
std::int64_t fixed(double value, int one) {
  const double exact = value * one, below = std::floor(exact);
  return static_cast<std::int64_t>(below) + (exact - below >= 0.5 ? 1 : 0);
}

// Applies one filter of three columns along x, then z. Ends repeat themselves.
template <class Filter>
ColumnHeights filtered(const ColumnHeights& heights, Vector cells, const Filter& filter) {
  ColumnHeights along(heights.size()), both(heights.size());
  const std::size_t x = cells.x, z = cells.z;
  for (std::size_t k = 0; k < z; ++k) {
    const std::int32_t* row = heights.data() + k * x;
    for (std::size_t i = 0; i < x; ++i)
      along[k * x + i] = filter(row[i > 0 ? i - 1 : 0], row[i], row[std::min(i + 1, x - 1)]);
  }
  for (std::size_t k = 0; k < z; ++k) {
    const std::int32_t *before = along.data() + (k > 0 ? k - 1 : 0) * x, *here = along.data() + k * x,
                       *behind = along.data() + std::min(k + 1, z - 1) * x;
    for (std::size_t i = 0; i < x; ++i) both[k * x + i] = filter(before[i], here[i], behind[i]);
  }
  return both;
}

ColumnHeights softened(ColumnHeights heights, Vector cells, int passes) {
  for (int pass = 0; pass < passes; ++pass) heights = filtered(heights, cells, picture::softened);
  return heights;
}

}  // namespace

ColumnHeights ground_heights(const scene::Terrain& terrain) {
  ColumnHeights heights(terrain.height.size());
  std::transform(terrain.height.begin(), terrain.height.end(), heights.begin(),
                 [](float height) { return static_cast<std::int32_t>(fixed(height, kHeight)); });
  return heights;
}

GroundMap::GroundMap(Vector cells, ColumnHeights heights, int passes, const scene::Vec3& color, bool textured)
    : cells_(cells),
      color_{fixed(color[0], picture::kColor), fixed(color[1], picture::kColor),
             fixed(color[2], picture::kColor)},
      passes_(passes) {
  const auto most = static_cast<std::int32_t>(cells.y * kHeight);
  for (std::int32_t& height : heights) height = std::clamp(height, 0, most);
  softened_ = softened(std::move(heights), cells, passes);
  bare_ = drawn_ = filtered(softened_, cells, picture::prefiltered);
  highest_ = *std::max_element(bare_.begin(), bare_.end());
  find_slopes();
  if (!textured || empty()) return;
  make_texels();
  make_bands();
}

bool GroundMap::lower(const ColumnHeights& wetness) {
  if (empty() || wetness == wetness_) return false;
  wetness_ = wetness;
  drawn_ = bare_;
  if (!wetness_.empty()) {
    ColumnHeights low = softened(wetness_, cells_, passes_);
    for (std::size_t i = 0; i < low.size(); ++i) low[i] = picture::lowered(softened_[i], low[i]);
    drawn_ = filtered(low, cells_, picture::prefiltered);
  }
  find_slopes();
  return true;
}

void GroundMap::find_slopes() {
  slopes_ = {};
  for (std::int64_t z = 0; z < cells_.z; ++z)
    for (std::int64_t x = 0; x < cells_.x; ++x) {
      const auto to = [&](std::int64_t nx, std::int64_t nz) {
        return std::int64_t{std::abs(drawn_[column(nx, nz)] - drawn_[column(x, z)])};
      };
      slopes_.x = std::max(slopes_.x, to(std::min(x + 1, cells_.x - 1), z));
      slopes_.z = std::max(slopes_.z, to(x, std::min(z + 1, cells_.z - 1)));
    }
}

// Finds the crossing, and leaves out samples that cannot reach the ground. At each sample a ray comes nearer
// by no more than its own fall and the largest slopes. The margin covers all roundings of places, weights and
// heights. All of it counts in 2^-32 cells.
picture::GroundCrossing GroundMap::find(const picture::Ray& ray) const {
  if (empty()) return {};
  const std::int64_t nearer = picture::magnitude(ray.step.x) * slopes_.x +
                              picture::magnitude(ray.step.z) * slopes_.z - ray.step.y * kHeight;
  const std::int64_t margin = ((slopes_.x + slopes_.z) << 13) + (8 << 20);
  constexpr std::int64_t kAll = std::int64_t{1} << 40;
  const auto heights = [&](std::int64_t x, std::int64_t z) { return drawn_[column(x, z)]; };
  return picture::first_ground(heights, cells_, highest_, ray, [&](std::int64_t above) {
    const std::int64_t gap = (above << picture::kPositionBits) - margin;
    return gap <= 0 ? 0 : nearer <= 0 ? kAll : gap / nearer;
  });
}

void GroundMap::make_texels() {
  fineness_ = picture::texel_fineness(cells_);
  const auto heights = [&](std::int64_t x, std::int64_t z) { return bare_[column(x, z)]; };
  const std::int64_t x = cells_.x << fineness_, z = cells_.z << fineness_;
  const auto place = [&](std::int64_t i, std::int64_t j) -> Vector {
    const std::int64_t px = picture::texel_middle(i, fineness_), pz = picture::texel_middle(j, fineness_);
    const std::int64_t height = picture::height_at(heights, cells_, px, pz);
    return {px, height << (picture::kPositionBits - picture::kHeightBits), pz};
  };
  // The relief has a texel more on each side.
  const std::int64_t row = x + 2;
  std::vector<std::int32_t> reliefs;
  reliefs.reserve(row * (z + 2));
  for (std::int64_t j = -1; j <= z; ++j)
    for (std::int64_t i = -1; i <= x; ++i) reliefs.push_back(picture::relief(place(i, j)));
  const auto bump = [&](std::int64_t at, std::int64_t stride) {
    return picture::bump(reliefs[at - stride], reliefs[at + stride], fineness_);
  };

  const auto [low, high] = std::minmax_element(bare_.begin(), bare_.end());
  texels_.reserve(x * z);
  for (std::int64_t j = 0; j < z; ++j)
    for (std::int64_t i = 0; i < x; ++i) {
      const Vector here = place(i, j);
      const Vector normal = picture::ground_normal(heights, cells_, here, Face::top);
      const Vector color = picture::rock_color(color_, picture::elevation(here.y, *low, *high), normal.y,
                                               picture::patches(here), picture::grain(here));
      const std::int64_t at = (j + 1) * row + i + 1;
      texels_.push_back({static_cast<std::uint16_t>(color.x), static_cast<std::uint16_t>(color.y),
                         static_cast<std::uint16_t>(color.z), bump(at, 1), bump(at, row)});
    }
}

void GroundMap::make_bands() {
  for (std::int64_t i = 0; i < cells_.y << picture::kBandFineness; ++i)
    bands_.push_back(static_cast<std::int16_t>(picture::band(i)));
  for (std::int64_t z = 0; z < cells_.z; ++z) {
    bends_[0].push_back(picture::bend({0, 0, picture::texel_middle(z, 0)}));
    bends_[1].push_back(picture::bend({cells_.x * picture::kCell, 0, picture::texel_middle(z, 0)}));
  }
  for (std::int64_t x = 0; x < cells_.x; ++x) {
    bends_[2].push_back(picture::bend({picture::texel_middle(x, 0), 0, 0}));
    bends_[3].push_back(picture::bend({picture::texel_middle(x, 0), 0, cells_.z * picture::kCell}));
  }
}

GroundMap::Paint GroundMap::paint(const picture::GroundCrossing& crossing) const {
  return told_paint(*this, crossing, picture::Silent{});
}

}  // namespace voxmelt::render
