#include "accuracy/front/pick.h"

#include <algorithm>
#include <limits>

namespace voxmelt::accuracy::front {
namespace {

// Fewer steps, rays and castings are less work, whatever a clock says. The viscous law has two keys, and
// which of their pairs is faster only a clock tells.
bool coarser_is_faster(Axis axis) { return axis != Axis::viscous; }

double judged_error(const Measured& point, bool curves_alone) {
  return curves_alone ? point.difference.curves.largest() : point.difference.error();
}

// Gives `setting` the choice that the other one made along the axis.
void take_along(Axis axis, const Setting& other, Setting& setting) {
  switch (axis) {
    case Axis::step:
      setting.step = other.step;
      return;
    case Axis::rays:
      setting.rays = other.rays;
      return;
    case Axis::visibility:
      setting.interval = other.interval;
      return;
    case Axis::viscous:
      setting.substeps_max = other.substeps_max;
      setting.stages_max = other.stages_max;
      return;
    case Axis::grid:
    case Axis::neighbours:
      return;  // no pick is made of them
  }
}

const Measured* find_usual(std::span<const Measured> points, Axis axis, const Setting& usual) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const Measured& point) {
    return point.axis == axis && point.setting == usual;
  });
  return found == points.end() ? nullptr : &*found;
}

}  // namespace

const Measured* cheapest_within(std::span<const Measured> points, Axis axis, const Setting& usual,
                                const Noise& noise, double bound) {
  const auto keeps = [&](const Measured& point) {
    if (point.reference) return ends_at_reference(axis);
    return noise.curves <= bound && judged_error(point, noise.map > bound) <= bound;
  };
  if (coarser_is_faster(axis)) {
    const auto first = std::find_if(points.begin(), points.end(), [&](const Measured& point) {
      return point.axis == axis && keeps(point);
    });
    return first == points.end() ? nullptr : &*first;
  }
  const Measured* cheapest = find_usual(points, axis, usual);
  if (cheapest != nullptr && !keeps(*cheapest)) cheapest = nullptr;
  double most =
      cheapest != nullptr ? (1 - kLeastSaving) * cheapest->seconds : std::numeric_limits<double>::infinity();
  for (const Measured& point : points) {
    if (point.axis != axis || point.reference || !keeps(point) || point.seconds >= most) continue;
    cheapest = &point;
    most = point.seconds;
  }
  if (cheapest != nullptr) return cheapest;
  for (const Measured& point : points)
    if (point.axis == axis && point.reference && keeps(point)) return &point;
  return nullptr;
}

Pick pick(std::span<const Measured> points, const Setting& usual, const Noise& noise, double bound) {
  Pick pick{.bound = bound, .setting = usual, .curves_alone = noise.map > bound};
  for (const Axis axis : kPickedAxes) {
    const Measured* taken = cheapest_within(points, axis, usual, noise, bound);
    const bool kept = taken != nullptr;
    if (!kept) taken = find_usual(points, axis, usual);
    if (taken == nullptr) continue;  // the scene has no such axis
    if (!kept) pick.without.push_back(axis);
    take_along(axis, taken->setting, pick.setting);
    pick.sum += judged_error(*taken, pick.curves_alone);
  }
  pick.none = !pick.without.empty() && pick.setting == usual;
  return pick;
}

}  // namespace voxmelt::accuracy::front
