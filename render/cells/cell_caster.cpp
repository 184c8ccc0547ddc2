#include "render/cells/cell_caster.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace voxmelt::render {
namespace {

using Triple = std::array<double, 3>;
constexpr std::size_t kAxes = 3;

Triple in_cells(picture::Vector v) {
  const auto part = [](std::int64_t value) { return static_cast<double>(value) / picture::kCell; };
  return {part(v.x), part(v.y), part(v.z)};
}

// A ray at a place of its way, in the cell that it is about to cross.
struct Walk {
  Walk(const Triple& from, const Triple& by) : start(from), step(by) {
    for (std::size_t a = 0; a < kAxes; ++a) per_cell[a] = step[a] == 0 ? 0 : 1 / step[a];
  }

  Triple start, step, per_cell{};  // per_cell: 1 / step
  double t = 0;
  CellIndex cell{};
  int axis = -1;  // that it crossed last

  double place(std::size_t a) const { return start[a] + t * step[a]; }

  // Goes in at the box low <= cell < high. Returns false if the ray passes it by.
  bool enter(const CellIndex& low, const CellIndex& high) {
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (low[a] >= high[a]) return false;
      if (step[a] == 0) {
        if (start[a] < low[a] || start[a] >= high[a]) return false;
        continue;
      }
      const double one = (low[a] - start[a]) * per_cell[a], other = (high[a] - start[a]) * per_cell[a];
      if (std::min(one, other) > t) {
        t = std::min(one, other);
        axis = static_cast<int>(a);
      }
      out = std::min(out, std::max(one, other));
    }
    if (t >= out) return false;
    for (std::size_t a = 0; a < kAxes; ++a) cell[a] = clamped(a, low[a], high[a]);
    if (axis >= 0) {
      const auto a = static_cast<std::size_t>(axis);
      cell[a] = step[a] > 0 ? low[a] : high[a] - 1;
    }
    return true;
  }

  // Leaves the cube of `side` cells around the cell. Rounding never leads out of it through another face.
  void leave(int side) {
    std::array<int, kAxes> low{};
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < kAxes; ++a) {
      low[a] = cell[a] & -side;
      if (step[a] == 0) continue;
      const double end = ((step[a] > 0 ? low[a] + side : low[a]) - start[a]) * per_cell[a];
      if (end >= out) continue;
      out = end;
      axis = static_cast<int>(a);
    }
    t = std::max(t, out);
    for (std::size_t a = 0; a < kAxes; ++a) cell[a] = clamped(a, low[a], low[a] + side);
    const auto a = static_cast<std::size_t>(axis);
    cell[a] = step[a] > 0 ? low[a] + side : low[a] - 1;
  }

 private:
  int clamped(std::size_t a, int low, int high) const {
    return std::clamp(static_cast<int>(place(a)), low, high - 1);  // low is no less than 0
  }
};

bool is_inside(const CellIndex& cell, const CellIndex& low, const CellIndex& high) {
  for (std::size_t a = 0; a < kAxes; ++a)
    if (cell[a] < low[a] || cell[a] >= high[a]) return false;
  return true;
}

}  // namespace

CellCaster::CellCaster(const FilledCells& filled, const picture::View& view,
                       const std::optional<CellCut>& cut)
    : filled_(filled), view_(view), high_{filled.grid().x, filled.grid().y, filled.grid().z} {
  if (!cut) return;
  cut_axis_ = cut->axis;
  const auto a = static_cast<std::size_t>(cut->axis);
  // Parallel rays come from a side, not from a place.
  const bool parallel = view.wide == picture::Vector{} && view.high == picture::Vector{};
  const bool from_above = parallel ? in_cells(view.forward)[a] < 0 : in_cells(view.eye)[a] > cut->at;
  (from_above ? high_ : low_)[a] = cut->at;
}

std::optional<SeenCell> CellCaster::see(std::int64_t across, std::int64_t down) const {
  const picture::Ray ray = picture::ray_through(view_, across, down, 0);
  Walk walk(in_cells(ray.start), in_cells(ray.step));
  if (!walk.enter(low_, high_)) return std::nullopt;
  bool first = true;
  while (is_inside(walk.cell, low_, high_)) {
    const bool brick = filled_.brick_of(walk.cell);
    if (brick && filled_.cell(walk.cell)) {
      SeenCell seen{walk.cell, walk.axis, 0, false, {walk.place(0), walk.place(1), walk.place(2)}};
      if (walk.axis < 0) return seen;
      seen.outwards = walk.step[static_cast<std::size_t>(walk.axis)] > 0 ? -1 : 1;
      seen.cut = first && walk.axis == cut_axis_;
      return seen;
    }
    first = false;
    walk.leave(brick ? 1 : FilledCells::kBrick);
  }
  return std::nullopt;
}

}  // namespace voxmelt::render
