#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "hwmodel/explore/batch.h"
#include "hwmodel/explore/explore_report.h"

namespace voxmelt::hwmodel::explore {
namespace {

using json = nlohmann::ordered_json;

double giga(const Point& p) { return static_cast<double>(p.speed) * 1e-6; }

const Point& point_of(const std::vector<BatchScene>& scenes, const BatchDesign& design, std::size_t s) {
  return scenes[s].swept.points[design.points[s]];
}

// Names what the design has for all scenes.
std::string shared_text(const BatchDesign& design) {
  std::string text = fmt::format("{} lanes x {} steps at {} MHz, channels of {}", design.hw.lanes,
                                 design.hw.cascade, design.clock_mhz, design.hw.fifo_depth);
  if (design.hw.substeps > 1) text += fmt::format(", {} sub-steps", design.hw.substeps);
  return text + (design.hw.coded ? ", coded" : "");
}

std::string row_of(const BatchScene& scene, const Point& own, const Point& shared, const Checked* checked) {
  std::string text = fmt::format("  {:<20} {:>9.3f} {:>9.3f} {:>7.1f} {:>6.1f}  ", scene.name, giga(own),
                                 giga(shared), 100 * giga(shared) / giga(own), 100 * shared.taken.fullest);
  if (checked == nullptr) return text + "predicted\n";
  if (!checked->good) return text + "DIFFERS\n" + checked->difference;
  return text + fmt::format("{}, {} steps: {:.3f}, {:+.2f} %\n",
                            checked->within_bounds() ? "verified" : "NOT WITHIN ITS BOUNDS", checked->steps,
                            static_cast<double>(checked->speed) * 1e-6, 100 * checked->error());
}

json hw_json(const Configuration& hw, int clock_mhz) {
  json result;
  for (const HwKey& key : kHwKeys)
    if (key.chosen()) result[std::string(key.name)] = key.get(hw);
  result["clock_mhz"] = clock_mhz;
  return result;
}

json point_json(const Point& p) {
  return {{"hw", hw_json(p.hw, p.clock_mhz)},
          {"cell_steps_per_second", p.speed * 1000},
          {"fullest", p.taken.fullest}};
}

}  // namespace

std::string batch_text(const std::vector<BatchScene>& scenes, const Batch& batch, Aim aim,
                       const std::vector<Checked>& checked) {
  for (std::size_t s = 0; s < batch.own.size(); ++s)
    if (!batch.own[s]) return fmt::format("No design fits for {}.\n", scenes[s].name);
  if (batch.designs.empty()) return "No design fits for all scenes.\n";
  const BatchDesign& best = batch.designs.front();
  std::string text = fmt::format("  {:<20} {:>9} {:>9} {:>7} {:>6}\n", "Gcell-steps/s", "its own", "shared",
                                 "share %", "full %");
  for (std::size_t s = 0; s < scenes.size(); ++s)
    text += row_of(scenes[s], scenes[s].swept.points[*batch.own[s]], point_of(scenes, best, s),
                   checked.empty() ? nullptr : &checked[s]);
  return text +
         fmt::format(
             "Of {} designs that fit for all {} scenes, {} has {}: {}. {} steps of each take {:.4g} s, "
             "and {:.4g} s with each scene's own best design; the worst share is {:.1f} % ({}).\n",
             batch.designs.size(), scenes.size(),
             aim == Aim::sum ? "the least sum of times" : "the greatest of the worst shares",
             shared_text(best), checked.empty() ? "predicted" : "simulated above",
             scenes.front().question.steps, best.seconds, batch.own_seconds, 100 * best.worst_share,
             scenes[best.worst].name);
}

std::string batch_csv(const std::vector<BatchScene>& scenes, const Batch& batch) {
  std::string text = "lanes,cascade,substeps,fifo_depth,overlap,coded,clock_mhz,seconds,worst_share,worst";
  for (const BatchScene& scene : scenes)
    text += "," + scene.name + "_tile," + scene.name + "_cell_steps_per_second";
  text += "\n";
  for (const BatchDesign& d : batch.designs) {
    text += fmt::format("{},{},{},{},{},{},{},{:.9g},{:.6f},{}", d.hw.lanes, d.hw.cascade, d.hw.substeps,
                        d.hw.fifo_depth, d.hw.overlap ? 1 : 0, d.hw.coded ? 1 : 0, d.clock_mhz, d.seconds,
                        d.worst_share, scenes[d.worst].name);
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      const Point& p = point_of(scenes, d, s);
      text += fmt::format(",{},{}000", p.hw.tile, p.speed);
    }
    text += "\n";
  }
  return text;
}

std::string batch_json(const std::vector<BatchScene>& scenes, const Batch& batch, Aim aim,
                       const std::vector<Checked>& checked) {
  json result{{"device", scenes.front().question.device.name},
              {"steps", scenes.front().question.steps},
              {"aim", aim == Aim::sum ? "sum" : "worst"},
              {"own_seconds", batch.own_seconds},
              {"designs", batch.designs.size()},
              {"answer", batch_text(scenes, batch, aim, checked)},
              {"best", json()},
              {"scenes", json::array()}};
  const bool found = !batch.designs.empty();
  if (found) {
    const BatchDesign& best = batch.designs.front();
    json hw = hw_json(best.hw, best.clock_mhz);
    hw.erase("tile");  // each scene has its own
    result["best"] = {{"hw", hw},
                      {"seconds", best.seconds},
                      {"worst_share", best.worst_share},
                      {"worst", scenes[best.worst].name}};
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const state::Grid& g = scenes[s].question.grid;
    json one{
        {"scene", scenes[s].name}, {"grid", {g.x, g.y, g.z}}, {"first_step", scenes[s].question.first_step}};
    if (s < batch.own.size() && batch.own[s]) one["own"] = point_json(scenes[s].swept.points[*batch.own[s]]);
    if (found) one["shared"] = point_json(point_of(scenes, batch.designs.front(), s));
    if (!checked.empty())
      one["simulated"] = {{"state", state_of(&checked[s])},
                          {"steps", checked[s].steps},
                          {"cell_steps_per_second", checked[s].speed * 1000},
                          {"error", checked[s].error()}};
    result["scenes"].push_back(one);
  }
  return result.dump(2) + '\n';
}

}  // namespace voxmelt::hwmodel::explore
