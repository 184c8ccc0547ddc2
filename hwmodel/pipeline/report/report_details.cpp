#include "hwmodel/pipeline/report/report_details.h"
#include "hwmodel/memory/ratio.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace voxmelt::hwmodel {
namespace {

using Json = nlohmann::ordered_json;

// Rounds to one digit behind the point, as the table shows it.
double percent(const Json& part, std::int64_t value) {
  return std::round(1000 * ratio(part.get<double>(), value)) / 10;
}

Json json_of(const Timeline& timeline, const Json& stages) {
  Json begins = Json::array(), rows = Json::array();
  for (std::size_t i = 0; i < timeline.stretches(); ++i) begins.push_back(i * timeline.width());
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    Json row{{"name", stages[stage]["name"]}, {"cascade", stages[stage]["cascade"]}};
    for (std::size_t i = 0; i < timeline.stretches(); ++i) {
      const StageCycles did = timeline.within(i, stage);
      for (std::size_t k = 0; k < kCycleClasses.size(); ++k)
        row[kCycleClasses[k]].push_back(did.*StageCycles::kParts[k]);
    }
    rows.push_back(row);
  }
  return {
      {"stretch_cycles", timeline.width()}, {"begins", begins}, {"end", timeline.cycles()}, {"stages", rows}};
}

// Returns upper bounds of cell-steps a cycle, each below the one before, and what the run reached. On a DRAM
// it adds what the run moves, and what it could move at most.
Json bounds(const Json& json, const VerifyReport& report, const Design& design,
            const Configuration& configuration) {
  const Shape& shape = design.shape;
  const double lanes_and_steps = configuration.lanes * configuration.cascade;
  const auto cells = static_cast<double>(shape.grid.cells());
  const double in_grid = lanes_and_steps * ratio(cells, shape.tokens() * shape.lanes);
  const double with_work = in_grid * ratio(report.steps, report.passes * configuration.cascade);
  const double done = cells * report.steps;
  const Json& traffic = json["traffic_bits_per_cycle"];
  const double bytes = (traffic["read"].get<double>() + traffic["written"].get<double>() +
                        traffic["irradiance"].get<double>() + traffic["pieces"].get<double>()) /
                       8;
  Json all{{"lanes_and_steps", lanes_and_steps},
           {"lanes_in_the_grid", in_grid},
           {"steps_with_work", with_work},
           {"fill_and_drain", ratio(done, report.predicted_cycles)},
           {"reached", ratio(done, report.cycles)},
           {"bytes_per_cycle", bytes},
           {"cell_steps_per_byte", ratio(lanes_and_steps, bytes)}};
  if (!report.most_bytes_per_cycle) return all;
  std::int64_t bits = 0;
  for (const StageReport& stage : report.stages) bits += stage.moved_bits;
  const double moved = ratio(bits, 8 * report.cycles);
  all["most_bytes_per_cycle"] = *report.most_bytes_per_cycle;
  all["moved_bytes_per_cycle"] = moved;
  all["cell_steps_per_moved_byte"] = ratio(all["reached"].get<double>(), moved);
  return all;
}

}  // namespace

void add_details(Json& json, const VerifyReport& report, const Design& design,
                 const Configuration& configuration) {
  for (Json& stage : json["stages"]) {
    std::int64_t bits = 0;
    for (const Json& buffer : stage["buffers"]) bits += buffer["total_bits"].get<std::int64_t>();
    stage["buffer_bits"] = bits;
    std::int64_t all = 0;
    for (const Json& cycles : stage["cycles"]) all += cycles.get<std::int64_t>();
    for (const auto& [name, cycles] : stage["cycles"].items()) stage["percent"][name] = percent(cycles, all);
  }
  json["trains"] = Json::array();
  for (const TrainReport& train : report.trains) {
    json["trains"].push_back({{"first_step", train.step},
                              {"passes", train.passes},
                              {"cycles", train.cycles},
                              {"predicted_cycles", train.predicted}});
    if (train.predicted_on_memory)
      json["trains"].back()["predicted_cycles_on_memory"] = *train.predicted_on_memory;
  }
  if (report.mismatch == nullptr) json["cell_steps_per_cycle"] = bounds(json, report, design, configuration);
  if (report.timeline.stretches() > 0) json["timeline"] = json_of(report.timeline, json["stages"]);
}

}  // namespace voxmelt::hwmodel
