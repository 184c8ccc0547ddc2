#include "hwmodel/explore/batch.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "hwmodel/explore/answer.h"

namespace voxmelt::hwmodel::explore {
namespace {

// All scenes have these in common: lanes, steps, depth, overlap, code, clock.
using Shared = std::tuple<int, int, int, bool, bool, int>;
Shared shared_of(const Point& p) {
  return {p.hw.lanes, p.hw.cascade, p.hw.fifo_depth, p.hw.overlap, p.hw.coded, p.clock_mhz};
}

// Finds the best point of a scene for every shared choice and number of sub-steps.
class BestOfTiles {
 public:
  explicit BestOfTiles(const Swept& swept) {
    for (std::size_t i = 0; i < swept.points.size(); ++i) {
      const Point& p = swept.points[i];
      if (!p.taken.fits()) continue;
      auto& best = found_[shared_of(p)];
      const auto [at, added] = best.try_emplace(p.hw.substeps, i);
      if (!added && preferred(p, swept.points[at->second])) at->second = i;
    }
  }
  // A scene of the paper law has no sub-steps, and others may have fewer: they leave copies out.
  std::optional<std::size_t> at(const Shared& shared, int substeps) const {
    const auto found = found_.find(shared);
    if (found == found_.end()) return {};
    const auto after = found->second.upper_bound(substeps);
    if (after == found->second.begin()) return {};
    return std::prev(after)->second;
  }
  const std::map<Shared, std::map<int, std::size_t>>& all() const { return found_; }

 private:
  std::map<Shared, std::map<int, std::size_t>> found_;
};

void weigh(BatchDesign& design, const std::vector<BatchScene>& scenes, const Batch& batch) {
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const std::vector<Point>& points = scenes[s].swept.points;
    const Point &point = points[design.points[s]], &own = points[*batch.own[s]];
    design.seconds += seconds_of(scenes[s].question, point);
    const double share = static_cast<double>(point.speed) / static_cast<double>(own.speed);
    if (s > 0 && share >= design.worst_share) continue;
    design.worst_share = share;
    design.worst = s;
  }
}

}  // namespace

double seconds_of(const Question& question, const Point& point) {
  return static_cast<double>(question.grid.cells()) * static_cast<double>(question.steps) /
         (static_cast<double>(point.speed) * 1e3);
}

Batch batch_of(const std::vector<BatchScene>& scenes, Aim aim) {
  Batch batch;
  std::vector<BestOfTiles> best;
  std::vector<int> substeps;  // that any scene tries
  for (const BatchScene& scene : scenes) {
    best.emplace_back(scene.swept);
    batch.own.push_back(best_point(scene.swept));
    for (const Point& p : scene.swept.points) substeps.push_back(p.hw.substeps);
    std::sort(substeps.begin(), substeps.end());
    substeps.erase(std::unique(substeps.begin(), substeps.end()), substeps.end());
    if (!batch.own.back()) return batch;
    batch.own_seconds += seconds_of(scene.question, scene.swept.points[*batch.own.back()]);
  }
  for (const auto& [shared, some] : best.front().all())
    for (const int copies : substeps) {
      BatchDesign design;
      for (const BestOfTiles& one : best)
        if (const auto point = one.at(shared, copies)) design.points.push_back(*point);
      if (design.points.size() < scenes.size()) continue;
      design.hw = scenes.front().swept.points[design.points.front()].hw;
      design.hw.substeps = copies;
      design.clock_mhz = std::get<5>(shared);
      weigh(design, scenes, batch);
      batch.designs.push_back(std::move(design));
    }
  std::stable_sort(batch.designs.begin(), batch.designs.end(),
                   [&](const BatchDesign& a, const BatchDesign& b) {
                     return aim == Aim::sum ? std::tuple(a.seconds, -a.worst_share, a.hw.substeps) <
                                                  std::tuple(b.seconds, -b.worst_share, b.hw.substeps)
                                            : std::tuple(-a.worst_share, a.seconds, a.hw.substeps) <
                                                  std::tuple(-b.worst_share, b.seconds, b.hw.substeps);
                   });
  return batch;
}

}  // namespace voxmelt::hwmodel::explore
