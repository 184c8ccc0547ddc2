#include "hwmodel/explore/ranges.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <string_view>
#include <tuple>
#include <utility>

#include "hwmodel/explore/answer.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr const char* kClock = "device.clock";

// Finds the best design of a sweep on other devices. Only what designs take is weighed anew, so it is quick.
class Search {
 public:
  explicit Search(const Swept& swept) : swept_(swept), order_(swept.points.size()), id_(swept.points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return swept.points[a].speed > swept.points[b].speed;
    });
    std::map<std::tuple<std::size_t, int, int, bool>, std::size_t> ids;  // of what a design takes
    for (std::size_t i = 0; i < swept.points.size(); ++i) {
      const Point& p = swept.points[i];
      id_[i] =
          ids.try_emplace({p.parts, p.hw.cascade, p.hw.fifo_depth, p.hw.coded}, ids.size()).first->second;
    }
    kinds_ = ids.size();
  }

  std::optional<Point> best_on(const Device& device) const {
    std::vector<std::optional<Taken>> known(kinds_);
    std::vector<bool> refused(kinds_);
    std::optional<Point> best;
    for (const std::size_t i : order_) {
      if (best && swept_.points[i].speed < best->speed) break;
      if (refused[id_[i]]) continue;
      Point point = swept_.points[i];
      if (!known[id_[i]] && too_large(swept_.parts[point.parts], point.hw, device)) {
        refused[id_[i]] = true;
        continue;
      }
      point.taken = taken(i, device, known);
      refused[id_[i]] = !point.taken.fits();
      if (point.taken.fits() && (!best || preferred(point, *best))) best = point;
    }
    return best;
  }
  std::vector<double> fullest_on(const Device& device) const {
    std::vector<std::optional<Taken>> known(kinds_);
    std::vector<double> fullest;
    for (std::size_t i = 0; i < id_.size(); ++i) fullest.push_back(taken(i, device, known).fullest);
    return fullest;
  }

 private:
  const Taken& taken(std::size_t i, const Device& device, std::vector<std::optional<Taken>>& known) const {
    const Point& p = swept_.points[i];
    std::optional<Taken>& taken = known[id_[i]];
    if (!taken) taken = taken_by(swept_.parts[p.parts], p.hw, device);
    return *taken;
  }

  const Swept& swept_;
  std::vector<std::size_t> order_;  // the fastest first
  std::vector<std::size_t> id_;     // equal for points that take the same
  std::size_t kinds_ = 0;
};

// Says if any stage of the designs has this number. All other numbers are taken to matter.
bool matters(const Coefficient& coefficient, const Swept& swept) {
  constexpr std::string_view kStage = "family.stage.";
  if (!coefficient.name.starts_with(kStage)) return true;
  const std::string_view name = std::string_view(coefficient.name).substr(kStage.size());
  const auto& stages = swept.parts.front().stages;
  return std::any_of(stages.begin(), stages.end(), [&](const StagePart& part) {
    return name.substr(0, name.find('.')) == name_of(part.kind);
  });
}

// The fastest designs have the highest clock, so others are not tried.
Swept at_clock(const Question& question, Axes axes, double mhz, const std::function<void()>& poll) {
  axes.clock_mhz = {static_cast<int>(mhz)};
  return sweep(question, axes, poll);
}

}  // namespace

Ranges ranges_of(const Question& question, const Axes& axes, const Swept& swept,
                 std::optional<std::size_t> best, const std::function<void()>& poll) {
  const auto begin = std::chrono::steady_clock::now();
  Ranges ranges;
  const auto fits = [&](const Device& device) {
    if (!best) return false;
    const Point& p = swept.points[*best];
    return taken_by(swept.parts[p.parts], p.hw, device).fits() && p.clock_mhz <= device.clock_mhz.value;
  };
  Device better = question.device, worse = question.device;
  const Search usual(swept);
  std::optional<Swept> fast, slow;  // at other clocks
  for (const Coefficient& one : coefficients_of(question.device)) {
    if (!matters(one, swept)) continue;
    const Device up = with_value(question.device, one.name, one.better),
                 down = with_value(question.device, one.name, one.worse);
    Alone alone{one, {}, fits(down)};
    if (one.name == kClock) {
      if (axes.clock_mhz.size() == 1) continue;  // the user chose it
      fast = at_clock(question, axes, one.better, poll);
      slow = at_clock(question, axes, one.worse, poll);
      alone.ends = {Search(*fast).best_on(up), Search(*slow).best_on(down)};
    } else {
      alone.ends = {usual.best_on(up), usual.best_on(down)};
    }
    better = with_value(better, one.name, one.better);
    worse = with_value(worse, one.name, one.worse);
    ranges.alone.push_back(std::move(alone));
    if (poll) poll();
  }
  ranges.all.better = fast ? Search(*fast).best_on(better) : usual.best_on(better);
  ranges.all.worse = slow ? Search(*slow).best_on(worse) : usual.best_on(worse);
  ranges.keeps_best = fits(worse);
  const std::vector<double> least = usual.fullest_on(better), most = usual.fullest_on(worse);
  for (std::size_t i = 0; i < least.size(); ++i) ranges.fullest.push_back({least[i], most[i]});
  std::stable_sort(ranges.alone.begin(), ranges.alone.end(),
                   [](const Alone& a, const Alone& b) { return a.ends.span() > b.ends.span(); });
  ranges.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return ranges;
}

}  // namespace voxmelt::hwmodel::explore
