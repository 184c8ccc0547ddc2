#include "report/svg/axis.h"

#include <cmath>

namespace voxmelt::page {
namespace {

constexpr int kFewTicks = 6;

// Returns 1, 2 or 5 times a power of ten, so that about kFewTicks of it make `range`.
double tick_distance(double range) {
  const double rough = range / kFewTicks, decade = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1., 2., 5.})
    if (rough <= step * decade * 1.0001) return step * decade;
  return 10 * decade;
}

}  // namespace

Axis::Axis(double low, double high, bool logarithmic, double from, double to)
    : low_(low), high_(high), logarithmic_(logarithmic && low > 0), from_(from), to_(to) {
  if (logarithmic_) {
    const bool wide = high_ / low_ > 300;
    for (double decade = std::pow(10, std::floor(std::log10(low_))); decade <= high_; decade *= 10)
      for (const double step : {1., 2., 5.})
        if ((step == 1 || !wide) && step * decade >= low_ * 0.999 && step * decade <= high_ * 1.001)
          ticks_.push_back(step * decade);
    return;
  }
  if (!(high_ > low_)) {
    low_ -= 0.5;
    high_ += 0.5;
  }
  const double distance = tick_distance(high_ - low_);
  low_ = std::floor(low_ / distance + 1e-9) * distance;
  high_ = std::ceil(high_ / distance - 1e-9) * distance;
  for (int i = 0; low_ + i * distance <= high_ + distance / 2; ++i) {
    const double tick = low_ + i * distance;
    ticks_.push_back(std::abs(tick) < distance / 1e6 ? 0 : tick);
  }
}

double Axis::along(double value) const {
  if (logarithmic_) return std::log(value / low_) / std::log(high_ / low_);
  return (value - low_) / (high_ - low_);
}

double Axis::operator()(double value) const { return from_ + (to_ - from_) * along(value); }

}  // namespace voxmelt::page
