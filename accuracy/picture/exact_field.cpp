#include "accuracy/picture/exact_field.h"

#include <algorithm>
#include <cmath>

#include "accuracy/picture/exact_walk.h"
#include "render/rule/sample.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kFarthest = 255;

struct Cell {
  int cell;
  double part;
};
// Returns the cell of a place, moved down by `shift`: half a cell, or nothing.
Cell cell_of(double p, double shift, int low, int high) {
  const double floor = std::clamp(std::floor(p - shift), static_cast<double>(low), static_cast<double>(high));
  return {static_cast<int>(floor), p - shift - floor};
}

// Holds the weights of a quadratic B-spline and of its slope, for cell - 1, cell, cell + 1.
struct Spline {
  std::array<double, 3> value, slope;
};
Spline spline_of(double u) {
  const double t = 1 - u;
  return {{t * t / 2, 1 - t * t / 2 - u * u / 2, u * u / 2}, {-t, t - u, u}};
}

}  // namespace

ExactField::ExactField(const render::PictureScene& scene) {
  const picture::Vector n = scene.levels.cells();
  cells_ = {static_cast<int>(n.x), static_cast<int>(n.y), static_cast<int>(n.z)};
  std::size_t size = 1;
  for (std::size_t a = 0; a < 3; ++a) size *= side_[a] = cells_[a] + 2 * kBorder;
  levels_.assign(size, picture::kAir);
  matter_.resize(size);
  for (int z = 0; z < cells_[2]; ++z)
    for (int y = 0; y < cells_[1]; ++y)
      for (int x = 0; x < cells_[0]; ++x) {
        levels_[at(x, y, z)] = static_cast<float>(scene.levels(x, y, z));
        const picture::Matter matter = scene.matter(x, y, z);
        matter_[at(x, y, z)] = {static_cast<std::uint8_t>(matter.liquid),
                                static_cast<std::uint8_t>(matter.heat),
                                static_cast<std::uint8_t>(matter.obstacle)};
        obstacles_ |= matter.obstacle > 0;
      }
  find_distances();
}

// Finds them in two sweeps, over the 13 neighbours before a cell and then over the 13 behind it.
void ExactField::find_distances() {
  far_.assign(levels_.size(), kFarthest);
  const auto row = static_cast<std::ptrdiff_t>(side_[0]), slice = row * static_cast<std::ptrdiff_t>(side_[1]);
  std::vector<std::ptrdiff_t> before;
  for (std::ptrdiff_t z = -1; z <= 0; ++z)
    for (std::ptrdiff_t y = -1; y <= 1; ++y)
      for (std::ptrdiff_t x = -1; x <= 1; ++x)
        if (z < 0 || y < 0 || (y == 0 && x < 0)) before.push_back(z * slice + y * row + x);
  const auto each = [&](const auto& work) {
    for (int z = -1; z < cells_[2]; ++z)
      for (int y = -1; y < cells_[1]; ++y)
        for (int x = -1; x < cells_[0]; ++x) work(at(x, y, z));
  };
  const auto far = [&](std::ptrdiff_t i) -> std::uint8_t& { return far_[i]; };
  const auto nearer = [&](std::ptrdiff_t i, std::ptrdiff_t from) {
    far(i) = static_cast<std::uint8_t>(std::min<int>(far(i), far(from) + 1));
  };
  each([&](std::ptrdiff_t i) {
    for (const std::ptrdiff_t corner :
         {std::ptrdiff_t{0}, std::ptrdiff_t{1}, row, row + 1, slice, slice + 1, slice + row, slice + row + 1})
      if (levels_[i + corner] >= 0) far(i) = 0;
  });
  each([&](std::ptrdiff_t i) {
    for (const std::ptrdiff_t to : before) nearer(i, i + to);
  });
  for (int z = cells_[2] - 1; z >= -1; --z)
    for (int y = cells_[1] - 1; y >= -1; --y)
      for (int x = cells_[0] - 1; x >= -1; --x) {
        const std::ptrdiff_t i = at(x, y, z);
        for (const std::ptrdiff_t to : before) nearer(i, i - to);
      }
}

double ExactField::level(Exact p) const {
  const Cell x = cell_of(p.x, 0.5, -kBorder, cells_[0]), y = cell_of(p.y, 0.5, -kBorder, cells_[1]),
             z = cell_of(p.z, 0.5, -kBorder, cells_[2]);
  return levels_between({x.cell, y.cell, z.cell}, p, p)[0];
}

// Follows the level from one place to another in a cell of eight levels. Each coefficient takes its
// coordinates from both ends.
Cubic ExactField::levels_between(const std::array<int, 3>& cell, Exact from, Exact to) const {
  const float* const first = levels_.data() + at(cell[0], cell[1], cell[2]);
  const std::size_t row = side_[0], slice = side_[0] * side_[1];
  const auto along_x = [&](std::size_t side, double w) { return blend(first[side], first[side + 1], w); };
  // Both ends are blended along x, for each of the four rows.
  const double ax = from.x - 0.5 - cell[0], ay = from.y - 0.5 - cell[1], az = from.z - 0.5 - cell[2];
  const double bx = to.x - 0.5 - cell[0], by = to.y - 0.5 - cell[1], bz = to.z - 0.5 - cell[2];
  const std::array<double, 4> a{along_x(0, ax), along_x(row, ax), along_x(slice, ax),
                                along_x(slice + row, ax)};
  const std::array<double, 4> b{along_x(0, bx), along_x(row, bx), along_x(slice, bx),
                                along_x(slice + row, bx)};
  const auto rest = [](const std::array<double, 4>& values, double y, double z) {
    return blend(blend(values[0], values[1], y), blend(values[2], values[3], y), z);
  };
  return {rest(a, ay, az), (rest(b, ay, az) + rest(a, by, az) + rest(a, ay, bz)) / 3,
          (rest(a, by, bz) + rest(b, ay, bz) + rest(b, by, az)) / 3, rest(b, by, bz)};
}

double ExactField::first_crossing(const ExactRay& ray) const {
  const std::array<double, 3> start{ray.start.x - 0.5, ray.start.y - 0.5, ray.start.z - 0.5};
  const std::array<double, 3> along{ray.along.x, ray.along.y, ray.along.z};
  const std::array<int, 3> low{-1, -1, -1}, high{cells_[0] - 1, cells_[1] - 1, cells_[2] - 1};
  const Span span = span_in<3>(start, along, {-1, -1, -1}, {high[0] + 1.0, high[1] + 1.0, high[2] + 1.0});
  if (span.first > span.last) return -1;
  Walk<3> walk(start, along, low, high, span.first);
  for (;;) {
    const std::array<int, 3> cell = walk.cell();
    for (std::size_t a = 0; a < 3; ++a)
      if (cell[a] < low[a] || cell[a] > high[a]) return -1;
    const int far = distance(cell[0], cell[1], cell[2]), free = std::max(far - 1, 0);
    std::array<int, 3> from{}, to{};
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] = std::max(cell[a] - free, low[a]);
      to[a] = std::min(cell[a] + free, high[a]);
    }
    const double out = walk.leaves(from, to);
    if (far == 0) {
      const double part = first_reached(levels_between(cell, ray.at(walk.t()), ray.at(out)));
      if (part >= 0) return blend(walk.t(), out, part);
    }
    walk.leave(from, to, out);
  }
}

Exact ExactField::normal(Exact p) const {
  const Cell cx = cell_of(p.x, 0, -1, cells_[0]), cy = cell_of(p.y, 0, -1, cells_[1]),
             cz = cell_of(p.z, 0, -1, cells_[2]);
  const Spline x = spline_of(cx.part), y = spline_of(cy.part), z = spline_of(cz.part);
  Exact slope;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double level = levels_[at(cx.cell + i - 1, cy.cell + j - 1, cz.cell + k - 1)];
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j),
                   c = static_cast<std::size_t>(k);
        slope = slope + Exact{x.slope[a] * y.value[b] * z.value[c], x.value[a] * y.slope[b] * z.value[c],
                              x.value[a] * y.value[b] * z.slope[c]} *
                            level;
      }
  return unit(slope * -1);
}

// Reads the bytes between the centres of cells.
ExactField::Matter ExactField::matter(Exact p) const {
  const auto axis = [](double at, int cells) {
    return cell_of(std::clamp(at, 0.5, cells - 0.5), 0.5, 0, cells - 1);
  };
  const Cell x = axis(p.x, cells_[0]), y = axis(p.y, cells_[1]), z = axis(p.z, cells_[2]);
  std::array<double, 3> sum{};
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight =
        (i != 0 ? x.part : 1 - x.part) * (j != 0 ? y.part : 1 - y.part) * (k != 0 ? z.part : 1 - z.part);
    const auto& bytes = matter_[at(x.cell + i, y.cell + j, z.cell + k)];
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * bytes[c];
  }
  return {sum[0], sum[1], sum[2]};
}

}  // namespace voxmelt::accuracy
