// An axis is a scale from numbers to a length, linear or logarithmic, with its ticks.
#pragma once

#include <vector>

namespace voxmelt::page {

class Axis {
 public:
  // Maps `low` to `high`, rounded outwards to ticks, onto from..to.
  Axis(double low, double high, bool logarithmic, double from, double to);
  double operator()(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double along(double value) const;  // 0..1
  double low_, high_;
  bool logarithmic_;
  double from_, to_;
  std::vector<double> ticks_;
};

}  // namespace voxmelt::page
