// The walk follows a ray through boxes of whole cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace voxmelt::accuracy {

// A span is the part of a ray in a box. Its axis is the one through which the ray comes in, or -1 if it
// starts inside.
struct Span {
  double first = 0, last = std::numeric_limits<double>::infinity();
  int axis = -1;
};

template <std::size_t kAxes>
Span span_in(const std::array<double, kAxes>& start, const std::array<double, kAxes>& along,
             const std::array<double, kAxes>& low, const std::array<double, kAxes>& high) {
  Span span;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (along[a] == 0) {
      if (start[a] < low[a] || start[a] >= high[a]) span.last = -1;
      continue;
    }
    const double one = (low[a] - start[a]) / along[a], other = (high[a] - start[a]) / along[a];
    const double in = std::min(one, other), out = std::max(one, other);
    if (in > span.first) {
      span.first = in;
      span.axis = static_cast<int>(a);
    }
    span.last = std::min(span.last, out);
  }
  return span;
}

// Keeps the cell of a ray's place `t`. The walk goes on from box to box of cells, and never backwards.
template <std::size_t kAxes>
class Walk {
 public:
  Walk(const std::array<double, kAxes>& start, const std::array<double, kAxes>& along,
       const std::array<int, kAxes>& low, const std::array<int, kAxes>& high, double t)
      : start_(start), along_(along), t_(t) {
    for (std::size_t a = 0; a < kAxes; ++a) cell_[a] = within(floor_at(a), low[a], high[a]);
  }

  double t() const { return t_; }
  const std::array<int, kAxes>& cell() const { return cell_; }

  // Returns the place where the ray leaves the cells low .. high, which hold the present one.
  double leaves(const std::array<int, kAxes>& low, const std::array<int, kAxes>& high) {
    double least = std::numeric_limits<double>::infinity();
    axis_ = 0;
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (along_[a] == 0) continue;
      const double side = along_[a] > 0 ? high[a] + 1 : low[a];
      const double t = (side - start_[a]) / along_[a];
      if (t < least) {
        least = t;
        axis_ = a;
      }
    }
    return std::max(least, t_);
  }
  // Goes to that place.
  void leave(const std::array<int, kAxes>& low, const std::array<int, kAxes>& high, double t) {
    t_ = t;
    for (std::size_t a = 0; a < kAxes; ++a)
      cell_[a] =
          a == axis_ ? (along_[a] > 0 ? high[a] + 1 : low[a] - 1) : within(floor_at(a), low[a], high[a]);
  }

 private:
  static int within(int i, int low, int high) { return std::clamp(i, low, high); }
  int floor_at(std::size_t a) const { return static_cast<int>(std::floor(start_[a] + along_[a] * t_)); }

  std::array<double, kAxes> start_, along_;
  double t_;
  std::array<int, kAxes> cell_{};
  std::size_t axis_ = 0;
};

}  // namespace voxmelt::accuracy
