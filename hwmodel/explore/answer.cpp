#include "hwmodel/explore/answer.h"

#include <algorithm>
#include <tuple>

namespace voxmelt::hwmodel::explore {
namespace {

auto order_of(const Point& p) {
  const Configuration& hw = p.hw;
  return std::tuple(-p.speed, p.taken.fullest, p.clock_mhz, hw.lanes, hw.cascade, hw.substeps, hw.fifo_depth,
                    hw.overlap ? 0 : 1, hw.coded ? 1 : 0, hw.tile);
}

template <class May>  // may(point): is it a candidate?
std::optional<std::size_t> best_of(const std::vector<Point>& points, May&& may) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (may(points[i]) && (!best || preferred(points[i], points[*best]))) best = i;
  return best;
}

std::vector<std::size_t> front_of(const std::vector<Point>& points, std::size_t number) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].taken.fits()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const std::int64_t x = amount_of(points[a], number), y = amount_of(points[b], number);
    return x != y ? x < y : preferred(points[a], points[b]);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].speed > points[front.back()].speed) front.push_back(i);
  return front;
}

Next next_of(const Question& question, const Swept& swept, std::int64_t speed, Resource r) {
  Next next;
  next.limit = speed;
  const std::int64_t there = question.device.usable()[r];
  if (there == 0) return next;  // nobody adds blocks of a kind that the device does not have
  for (std::size_t i = 0; i < swept.points.size(); ++i) {
    const Point& point = swept.points[i];
    if (point.speed <= speed) continue;
    const std::optional<std::int64_t> least =
        least_of(r, swept.parts[point.parts], point.hw, question.device);
    if (!least) continue;
    next.limit = std::max(next.limit, point.speed);
    const std::int64_t more = *least - there;
    if (!next.point || more < next.more ||
        (more == next.more && preferred(point, swept.points[*next.point]))) {
      next.point = i;
      next.more = more;
    }
  }
  return next;
}

// Returns the best speed of all designs that fit on the device, or 0 if none does.
std::int64_t best_speed(const Question& question, const Axes& axes) {
  const Swept swept = sweep(question, axes, {});
  const auto best = best_of(swept.points, [](const Point& p) { return p.taken.fits(); });
  return best ? swept.points[*best].speed : 0;
}

}  // namespace

std::string_view front_name(std::size_t front) {
  return front < kResources ? kResourceNames[front] : front == kClockFront ? "clock" : "energy";
}

std::int64_t amount_of(const Point& point, std::size_t front) {
  if (front < kResources) return point.taken.amounts[front];
  return front == kClockFront ? point.clock_mhz : point.energy;
}

bool preferred(const Point& a, const Point& b) { return order_of(a) < order_of(b); }

std::optional<std::size_t> best_point(const Swept& swept) {
  return best_of(swept.points, [](const Point& p) { return p.taken.fits(); });
}

Answer answer_of(const Question& question, const Axes& axes, const Swept& swept) {
  Answer answer;
  answer.best = best_point(swept);
  const std::int64_t speed = answer.best ? swept.points[*answer.best].speed : 0;
  for (std::size_t f = 0; f < kFronts; ++f) {
    answer.fronts[f] = front_of(swept.points, f);
    answer.front.insert(answer.front.end(), answer.fronts[f].begin(), answer.fronts[f].end());
  }
  if (answer.best) answer.frugal = answer.fronts[kEnergyFront].front();
  for (const Resource r : kEachResource) answer.next[r] = next_of(question, swept, speed, r);
  std::sort(answer.front.begin(), answer.front.end(),
            [&](std::size_t a, std::size_t b) { return preferred(swept.points[a], swept.points[b]); });
  answer.front.erase(std::unique(answer.front.begin(), answer.front.end()), answer.front.end());
  if (!answer.best) return answer;

  Axes at_clock = axes;  // the highest is enough: none is slower at a higher clock
  at_clock.clock_mhz = {*std::max_element(axes.clock_mhz.begin(), axes.clock_mhz.end())};
  Question other = question;
  if (question.memory) {
    other.memory->channels *= 2;
    answer.with_twice_the_memory = best_speed(other, at_clock);
    other.memory.reset();
  }
  answer.with_any_memory = best_speed(other, at_clock);
  answer.next_clock_mhz = at_clock.clock_mhz.front() + std::max(1, at_clock.clock_mhz.front() / 12);
  at_clock.clock_mhz = {answer.next_clock_mhz};
  answer.with_next_clock = best_speed(question, at_clock);
  return answer;
}

}  // namespace voxmelt::hwmodel::explore
