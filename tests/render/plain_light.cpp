#include "tests/render/plain_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/rule/light_grid.h"
#include "render/rule/matter.h"

namespace voxmelt::test {
namespace {

using picture::Vector;
using render::DensityField;
using render::LightBytes;
using render::LightMatter;
using render::LightPlane;

// Views a volume as slices along an axis, from the side where the light comes in.
class Slices {
 public:
  Slices(const LightPlane& plane, int axis, bool from_high)
      : size_{plane.count.x, plane.count.y, plane.count.z},
        stride_{1, plane.count.x, plane.count.x * plane.count.y},
        axis_(axis),
        u_(axis == 0 ? 1 : 0),
        v_(axis == 2 ? 1 : 2),
        from_high_(from_high) {}

  std::int64_t count() const { return size_[axis_]; }
  std::int64_t u() const { return size_[u_]; }
  std::int64_t v() const { return size_[v_]; }
  std::size_t at(std::int64_t slice, std::int64_t iu, std::int64_t iv) const {
    const std::int64_t along = from_high_ ? count() - 1 - slice : slice;
    return static_cast<std::size_t>(along * stride_[axis_] + iu * stride_[u_] + iv * stride_[v_]);
  }

 private:
  std::int64_t size_[3], stride_[3];
  int axis_, u_, v_;
  bool from_high_;
};

// Holds one slice of bytes. Beyond its sides there is `outside`.
class Slice {
 public:
  Slice(std::int64_t u, std::int64_t v, std::int32_t outside)
      : u_(u), v_(v), outside_(outside), cells_(static_cast<std::size_t>(u * v), outside) {}
  std::int32_t operator()(std::int64_t iu, std::int64_t iv) const {
    return iu < 0 || iv < 0 || iu >= u_ || iv >= v_ ? outside_
                                                    : cells_[static_cast<std::size_t>(iv * u_ + iu)];
  }
  std::int32_t& set(std::int64_t iu, std::int64_t iv) {
    return cells_[static_cast<std::size_t>(iv * u_ + iu)];
  }

 private:
  std::int64_t u_, v_;
  std::int32_t outside_;
  std::vector<std::int32_t> cells_;
};

// Calls leave(cell) for the light that leaves each cell of a slice. Calls arrive(cell, value) for the light
// that arrives in the next slice, filtered first along u and then along v.
template <class FilterU, class FilterV, class Leave, class Arrive>
void sweep(const Slices& slices, std::int32_t outside, const FilterU& filter_u, const FilterV& filter_v,
           const Leave& leave, const Arrive& arrive) {
  Slice left(slices.u(), slices.v(), outside), along(slices.u(), slices.v(), outside);
  for (std::int64_t s = 0; s < slices.count(); ++s) {
    for (std::int64_t v = 0; v < slices.v(); ++v)
      for (std::int64_t u = 0; u < slices.u(); ++u)
        along.set(u, v) = filter_u([&](std::int64_t d) { return left(u + d, v); });
    for (std::int64_t v = 0; v < slices.v(); ++v)
      for (std::int64_t u = 0; u < slices.u(); ++u)
        arrive(slices.at(s, u, v), filter_v([&](std::int64_t d) { return along(u, v + d); }));
    for (std::int64_t v = 0; v < slices.v(); ++v)
      for (std::int64_t u = 0; u < slices.u(); ++u) left.set(u, v) = leave(slices.at(s, u, v));
  }
}

constexpr auto kSpread = [](const auto& at) {
  return picture::spread({at(-2), at(-1), at(0), at(1), at(2)});
};

std::vector<std::int32_t> losses(const LightPlane& density) {
  std::vector<std::int32_t> all;
  all.reserve(density.cells.size());
  for (const std::uint8_t cell : density.cells) all.push_back(picture::loss_of(cell));
  return all;
}

// Sweeps along the axis of the direction's largest component. In a tie y comes before x, and x before z. A
// cell at (u, v) of a slice lies between the rays around (u, v) plus the shift. A ray lies between the cells
// around it less the shift.
void sweep_lamp(const LightMatter& matter, const std::vector<std::int32_t>& loss, Vector to_light,
                std::vector<LightBytes>& cells) {
  const std::int64_t component[3] = {to_light.x, to_light.y, to_light.z};
  int axis = 1;
  for (const int other : {0, 2})
    if (picture::magnitude(component[other]) > picture::magnitude(component[axis])) axis = other;
  const Slices slices(matter.density, axis, component[axis] > 0);
  const auto slope = [&](int other) {
    return static_cast<std::int32_t>(
        picture::floor_divided(component[other] * picture::kLength, picture::magnitude(component[axis])));
  };
  const std::int32_t slope_u = slope(axis == 0 ? 1 : 0), slope_v = slope(axis == 2 ? 1 : 2);

  // Rays from `low` on pass through the grid, at the first slice or at the last.
  const auto low = [&](std::int32_t s) {
    return std::min<std::int64_t>(picture::shift_at(slices.count(), s).cells, 0) - 1;
  };
  const auto more = [&](std::int32_t s) {
    return picture::magnitude(picture::shift_at(slices.count(), s).cells) + 4;
  };
  const std::int64_t low_u = low(slope_u), low_v = low(slope_v);
  const std::int64_t count_u = slices.u() + more(slope_u), count_v = slices.v() + more(slope_v);
  Slice rays(count_u, count_v, 255), softened(count_u, count_v, 255);
  for (std::int64_t s = 0; s < slices.count(); ++s) {
    const picture::Shift u = picture::shift_at(s, slope_u), v = picture::shift_at(s, slope_v);
    for (std::int64_t j = 0; j < slices.v(); ++j)
      for (std::int64_t i = 0; i < slices.u(); ++i) {
        const std::int64_t a = i + u.cells - low_u, b = j + v.cells - low_v;
        const auto along = [&](std::int64_t row) {
          return picture::blended(rays(a, row), rays(a + 1, row), u.part);
        };
        cells[slices.at(s, i, j)].lamp =
            static_cast<std::uint8_t>(picture::blended(along(b), along(b + 1), v.part));
      }
    const auto lost = [&](std::int64_t i, std::int64_t j) {
      return i < 0 || j < 0 || i >= slices.u() || j >= slices.v() ? 0 : loss[slices.at(s, i, j)];
    };
    for (std::int64_t b = 0; b < count_v; ++b)
      for (std::int64_t a = 0; a < count_u; ++a) {
        const std::int64_t i = a + low_u - u.cells, j = b + low_v - v.cells;
        const auto along = [&](std::int64_t row) {
          return picture::blended(lost(i, row), lost(i - 1, row), u.part);
        };
        rays.set(a, b) = picture::passed(rays(a, b), picture::blended(along(j), along(j - 1), v.part));
      }
    for (std::int64_t b = 0; b < count_v; ++b)
      for (std::int64_t a = 0; a < count_u; ++a)
        softened.set(a, b) = picture::softer(rays(a - 1, b), rays(a, b), rays(a + 1, b));
    for (std::int64_t b = 0; b < count_v; ++b)
      for (std::int64_t a = 0; a < count_u; ++a)
        rays.set(a, b) = picture::softer(softened(a, b - 1), softened(a, b), softened(a, b + 1));
  }
}

void sweep_side(const LightMatter& matter, const std::vector<std::int32_t>& loss, std::size_t side,
                std::vector<LightBytes>& cells) {
  const Slices slices(matter.density, static_cast<int>(side / 2), side % 2 == 0);
  sweep(
      slices, 255, kSpread, kSpread,
      [&](std::size_t i) { return picture::passed(cells[i].open[side], loss[i]); },
      [&](std::size_t i, std::int32_t value) {
        cells[i].open[side] = static_cast<std::uint8_t>(picture::opened(value));
      });
  if (matter.emission.cells.empty()) return;
  sweep(
      slices, 0, kSpread, kSpread,
      [&](std::size_t i) { return picture::glowing(cells[i].glow[side], loss[i], matter.emission.cells[i]); },
      [&](std::size_t i, std::int32_t value) {
        cells[i].glow[side] = static_cast<std::uint8_t>(picture::faded(value));
      });
}

// Calls visit(x, y, z) for the cells of a cell of light that lie in the grid.
template <class Visit>
void for_cells(const state::Grid& grid, int shift, picture::Vector at, const Visit& visit) {
  const auto end = [&](std::int64_t i, int side) {
    return static_cast<int>(std::min<std::int64_t>((i + 1) << shift, side));
  };
  for (int z = static_cast<int>(at.z << shift); z < end(at.z, grid.z); ++z)
    for (int y = static_cast<int>(at.y << shift); y < end(at.y, grid.y); ++y)
      for (int x = static_cast<int>(at.x << shift); x < end(at.x, grid.x); ++x) visit(x, y, z);
}

// Returns the rest of the density of clear matter, in 256ths. It is in double, as far as the rule's roundings
// let it.
std::int64_t plain_share(double half, int width) {
  const double per_cell = std::min(std::floor(4096 / std::max(half, 1.0 / 64)), 4096.0) / 16;
  const double entry = std::floor(width * per_cell);
  const double passes = entry < 2047 ? std::round(32768 * std::exp2(-entry / 256)) : 0;
  return static_cast<std::int64_t>(std::floor(180 * (256 - std::floor(passes / 128)) / 256));
}

}  // namespace

LightMatter plain_light_matter(const DensityField& field, const std::vector<std::int32_t>& ground,
                               const picture::Look& look) {
  const state::Grid& grid = field.grid();
  const picture::Vector cells{grid.x, grid.y, grid.z}, count = picture::light_cells(cells);
  const int shift = picture::light_shift(cells);
  LightMatter light_matter{{count, 0}, {}};
  if (look.glow) light_matter.emission = {count, 0};
  const bool clear = !look.glow && (look.clear[0] > 0 || look.clear[1] > 0 || look.clear[2] > 0);
  const std::int64_t share = clear ? plain_share(look.clear[1] / 64.0, 1 << shift) : 0;
  for (std::int64_t z = 0; z < count.z; ++z)
    for (std::int64_t y = 0; y < count.y; ++y)
      for (std::int64_t x = 0; x < count.x; ++x) {
        std::int64_t matter = 0, obstacle = 0, earth = 0, light = 0;
        const std::int64_t floor = (y << shift) * 4096, height = std::int64_t{4096} << shift;
        for_cells(grid, shift, {x, y, z}, [&](int cx, int cy, int cz) {
          const std::size_t i = grid.index(cx, cy, cz);
          matter += field.intensity()[i];
          if (field.has_obstacles()) obstacle += field.obstacle()[i];
          if (cy == y << shift && !ground.empty())
            earth += std::clamp<std::int64_t>(
                ground[static_cast<std::size_t>(cz) * static_cast<std::size_t>(grid.x) +
                       static_cast<std::size_t>(cx)] -
                    floor,
                0, height);
          if (look.glow)
            light += picture::emission_of(
                field.liquid()[i],
                picture::matter_of(field.solid()[i], field.liquid()[i], field.heat()[i], 0, look).heat);
        });
        const std::size_t i = light_matter.density.index(x, y, z);
        matter >>= 3 * shift + 8;
        obstacle = std::min(obstacle >> (3 * shift + 8), matter);
        if (clear) {
          matter -= obstacle;
          if (matter > 12) matter = 12 + (matter - 12) * share / 256;
          matter += obstacle;
        }
        light_matter.density.cells[i] =
            static_cast<std::uint8_t>(std::max(matter, (earth * 255) >> (3 * shift + 12)));
        if (look.glow) light_matter.emission.cells[i] = static_cast<std::uint8_t>(light >> (3 * shift));
      }
  return light_matter;
}

std::vector<LightBytes> plain_light(const LightMatter& matter, Vector to_light) {
  const std::vector<std::int32_t> loss = losses(matter.density);
  std::vector<LightBytes> cells(matter.density.cells.size());
  sweep_lamp(matter, loss, to_light, cells);
  for (std::size_t side = 0; side < picture::kSides; ++side) sweep_side(matter, loss, side, cells);
  return cells;
}

}  // namespace voxmelt::test
