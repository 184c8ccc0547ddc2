#include "kernel/run/io/surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace voxmelt::io {
namespace {

constexpr int kFull = 4096;
constexpr int kCorners = 8;  // of a cube; corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1)
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Six tetrahedra around the diagonal from corner 0 to corner 7 fill a cube. Those of neighbours meet in whole
// faces, so the surface has no gaps. Each walks from 0 to 7 along the three axes, in another order.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

// Goes through cubes whose corners are middles of cells, with a border of air, plane after plane.
class Extraction {
 public:
  explicit Extraction(const Moment& moment)
      : volume_(moment.volume),
        lattice_(moment.surface),
        inside_(moment.surface.inside),
        width_(volume_.grid.x + 2),
        height_(volume_.grid.y + 2) {
    for (std::vector<std::uint16_t>* plane : {&below_, &above_})
      plane->assign(std::size_t(width_) * height_, 0);
    for (std::vector<std::uint32_t>* plane : {&made_below_, &made_above_})
      plane->assign(std::size_t(width_) * height_ * kCorners, kNone);
  }

  Surface run(const Poll& poll) {
    for (int z = 0; z <= volume_.grid.z; ++z) {  // cubes between the middles of cells z - 1 and z
      take_plane(z);
      const bool matter = matter_below_ || matter_above_;
      for (int y = 0; matter && y + 1 < height_; ++y) add_row(y, z);
      std::swap(below_, above_);
      std::swap(made_below_, made_above_);
      if (matter) std::ranges::fill(made_above_, kNone);
      matter_below_ = matter_above_;
      if (poll) poll();
    }
    return std::move(surface_);
  }

 private:
  std::size_t place(int x, int y) const { return std::size_t(y) * width_ + x; }

  // Takes the numbers of the cells of slice z, or air beyond the grid. Cell (x, y) has place (x + 1, y + 1).
  void take_plane(int z) {
    std::ranges::fill(above_, std::uint16_t{0});
    matter_above_ = false;
    if (z == volume_.grid.z) return;
    if (lattice_.numbers == nullptr)
      take_amounts(z);
    else
      take_numbers(z);
  }

  void take_numbers(int z) {
    for (int y = 0; y < volume_.grid.y; ++y) {
      const std::uint16_t* const row = lattice_.numbers + volume_.grid.index(0, y, z);
      std::copy_n(row, volume_.grid.x, above_.begin() + static_cast<std::ptrdiff_t>(place(1, y + 1)));
      matter_above_ = matter_above_ || std::any_of(row, row + volume_.grid.x, [](int n) { return n != 0; });
    }
  }

  void take_amounts(int z) {
    for (int y = 0; y < volume_.grid.y; ++y) {
      const auto solid = volume_.solid.row(y, z), liquid = volume_.liquid.row(y, z);
      const std::uint16_t* const amount = volume_.amount.row(y, z);
      for (int x = 0; x < volume_.grid.x; ++x) {
        const std::size_t word = static_cast<std::size_t>(x) / 64;
        if (((solid[word] | liquid[word]) >> (x & 63) & 1) == 0) continue;
        above_[place(x + 1, y + 1)] = std::min<std::uint16_t>(amount[x], kFull);
        matter_above_ = true;
      }
    }
  }

  void add_row(int y, int z) {
    for (int x = 0; x + 1 < width_; ++x) {
      std::array<std::uint16_t, kCorners> amounts{};
      int inside = 0;
      for (int corner = 0; corner < kCorners; ++corner) {
        const auto& plane = (corner & 4) != 0 ? above_ : below_;
        amounts[corner] = plane[place(x + (corner & 1), y + (corner >> 1 & 1))];
        inside += amounts[corner] >= inside_ ? 1 : 0;
      }
      if (inside == 0 || inside == kCorners) continue;
      for (const auto& tetrahedron : kTetrahedra) add_tetrahedron({x, y, z}, amounts, tetrahedron);
    }
  }

  void add_tetrahedron(const std::array<int, 3>& cube, const std::array<std::uint16_t, kCorners>& amounts,
                       const std::array<int, 4>& corners) {
    std::array<int, 4> in{}, out{};
    int ins = 0, outs = 0;
    for (const int corner : corners) {
      if (amounts[corner] >= inside_)
        in[ins++] = corner;
      else
        out[outs++] = corner;
    }
    if (ins == 0 || outs == 0) return;
    const auto on = [&](int a, int b) { return vertex(cube, amounts, a, b); };
    if (ins == 2) {  // a quadrangle, in the order of its rim
      const std::array rim{on(in[0], out[0]), on(in[0], out[1]), on(in[1], out[1]), on(in[1], out[0])};
      add_triangle({rim[0], rim[1], rim[2]}, in[0], out[0]);
      add_triangle({rim[0], rim[2], rim[3]}, in[0], out[0]);
    } else if (ins == 1) {
      add_triangle({on(in[0], out[0]), on(in[0], out[1]), on(in[0], out[2])}, in[0], out[0]);
    } else {
      add_triangle({on(in[0], out[0]), on(in[1], out[0]), on(in[2], out[0])}, in[0], out[0]);
    }
  }

  // Adds a triangle that separates two corners, turned so that it is seen from the outer one.
  void add_triangle(std::array<std::uint32_t, 3> triangle, int in, int out) {
    const auto& [a, b, c] = std::array{surface_.vertices[triangle[0]].at, surface_.vertices[triangle[1]].at,
                                       surface_.vertices[triangle[2]].at};
    double outwards = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double normal =
          (double{b[j]} - a[j]) * (double{c[k]} - a[k]) - (double{b[k]} - a[k]) * (double{c[j]} - a[j]);
      outwards += normal * ((out >> i & 1) - (in >> i & 1));
    }
    if (outwards < 0) std::swap(triangle[1], triangle[2]);
    surface_.triangles.push_back(triangle);
  }

  // Returns the vertex between two corners of a cube. Other cubes share it: it belongs to the lower corner,
  // and to the direction from there.
  std::uint32_t vertex(const std::array<int, 3>& cube, const std::array<std::uint16_t, kCorners>& amounts,
                       int one, int other) {
    const int low = std::min(one, other),
              high = std::max(one, other);  // the bits of `low` are bits of `high`
    const std::size_t at = place(cube[0] + (low & 1), cube[1] + (low >> 1 & 1));
    std::uint32_t& made = ((low & 4) != 0 ? made_above_ : made_below_)[at * kCorners + (high - low)];
    if (made != kNone) return made;
    if (surface_.vertices.size() == kNone) throw std::length_error("a surface of 2^32 vertices");
    made = static_cast<std::uint32_t>(surface_.vertices.size());
    const int in = amounts[low] >= inside_ ? low : high;
    const double part = share(cube, amounts, low, high, low + high - in);
    SurfaceVertex vertex;
    for (int i = 0; i < 3; ++i) {
      const int from = low >> i & 1, to = high >> i & 1;
      // The plane of place 0 holds the middles of cells -1.
      vertex.at[i] = static_cast<float>(cube[i] - 0.5 + from + part * (to - from));
    }
    const std::array<int, 3> cell = cell_at(cube, in);
    describe(vertex, cell);
    surface_.vertices.push_back(vertex);
    return made;
  }

  static std::array<int, 3> cell_at(const std::array<int, 3>& cube, int corner) {
    return {cube[0] - 1 + (corner & 1), cube[1] - 1 + (corner >> 1 & 1), cube[2] - 1 + (corner >> 2 & 1)};
  }

  // Returns the way from the lower corner at which the surface lies, as a part of that to the higher one. It
  // is half of it where matter meets what is inert, or the border of the grid.
  double share(const std::array<int, 3>& cube, const std::array<std::uint16_t, kCorners>& amounts, int low,
               int high, int out) const {
    const std::array<int, 3> cell = cell_at(cube, out);
    if (!volume_.grid.contains(cell[0], cell[1], cell[2]) || volume_.inert.test(cell[0], cell[1], cell[2]))
      return 0.5;
    const double between = inside_ - 0.5;  // no number is this, so no vertex is a middle of a cell
    return (between - amounts[low]) / (amounts[high] - amounts[low]);
  }

  bool is_matter(const std::array<int, 3>& cell) const {
    return volume_.grid.contains(cell[0], cell[1], cell[2]) &&
           (volume_.solid.test(cell[0], cell[1], cell[2]) || volume_.liquid.test(cell[0], cell[1], cell[2]));
  }

  // A lattice of filtered numbers is within its surface a little beyond matter.
  std::array<int, 3> matter_near(const std::array<int, 3>& cell) const {
    std::array<int, 3> nearest = cell;
    int least = is_matter(cell) ? 0 : 4;  // the square of a way
    for (int dz = -1; least > 0 && dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::array<int, 3> beside{cell[0] + dx, cell[1] + dy, cell[2] + dz};
          const int way = dx * dx + dy * dy + dz * dz;
          if (way >= least || !is_matter(beside)) continue;
          least = way;
          nearest = beside;
        }
    return nearest;
  }

  void describe(SurfaceVertex& vertex, const std::array<int, 3>& inner) const {
    const std::array<int, 3> cell = matter_near(inner);
    const state::Slot at = volume_.at(cell[0], cell[1], cell[2]);
    vertex.heat = volume_.heat.empty() ? 0 : volume_.heat[at];
    vertex.material = volume_.material.empty() ? 0 : volume_.material[at];
    vertex.liquid = volume_.liquid.test(cell[0], cell[1], cell[2]) ? 1 : 0;
  }

  const state::Volume& volume_;
  Lattice lattice_;
  int inside_;
  int width_, height_;  // places of a plane
  std::vector<std::uint16_t> below_, above_;
  std::vector<std::uint32_t> made_below_, made_above_;  // vertices by lower corner and direction
  bool matter_below_ = false, matter_above_ = false;
  Surface surface_;
};

}  // namespace

Surface surface_of(const Moment& moment, const Poll& poll) { return Extraction(moment).run(poll); }

}  // namespace voxmelt::io
