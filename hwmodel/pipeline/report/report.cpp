#include "hwmodel/pipeline/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/report/report_details.h"

namespace voxmelt::hwmodel {
namespace {

using json = nlohmann::ordered_json;

json hw_json(const Configuration& configuration) {
  json result;
  for (const HwKey& key : kHwKeys) result[std::string(key.name)] = key.get(configuration);
  return result;
}

json stage_json(const StageReport& stage) {
  json buffers = json::array();
  for (const BufferCost& b : stage.buffers)
    buffers.push_back({{"name", b.name},
                       {"words", b.words},
                       {"lanes", b.lanes},
                       {"bits", b.bits},
                       {"total_bits", b.total()}});
  json cycles;
  for (std::size_t i = 0; i < kCycleClasses.size(); ++i)
    cycles[kCycleClasses[i]] = stage.cycles.*StageCycles::kParts[i];
  return {{"name", name_of(stage.kind)},
          {"phase", name_of(phase_of(stage.kind))},
          {"cascade", stage.cascade},
          {"lag", stage.lag},
          {"moved_bits", stage.moved_bits},
          {"cycles", cycles},
          {"buffers", buffers},
          {"per_lane", {{"multipliers", stage.units.multipliers}, {"dividers", stage.units.dividers}}},
          {"random_blocks_per_8_lanes", stage.units.random_blocks}};
}

json mismatch_json(const Mismatch& m) {
  return {{"kind", name_of(m.kind)},
          {"where", m.where},
          {"phase", name_of(m.phase)},
          {"step", m.step},
          {"cascade", m.cascade},
          {"lane", m.lane},
          {"cycle", m.cycle},
          {"cell", {m.x, m.y, m.z}},
          {"field", m.field},
          {"expected", m.expected},
          {"actual", m.actual},
          {"detail", m.detail},
          {"neighbourhood", m.neighbourhood}};
}

std::int64_t bits_of(const StageReport& stage) {
  std::int64_t bits = 0;
  for (const BufferCost& buffer : stage.buffers) bits += buffer.total();
  return bits;
}

std::int64_t buffer_bits(const VerifyReport& report) {
  std::int64_t bits = 0;
  for (const StageReport& stage : report.stages) bits += bits_of(stage);
  return bits;
}

// Holds one line per stage, with its cycles over all time steps of the cascade together.
struct Row {
  StageReport stage;
  int times = 1;
};
std::vector<Row> rows_of(const std::vector<StageReport>& stages) {
  std::vector<Row> rows;
  for (const StageReport& stage : stages) {
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.stage.kind == stage.kind; });
    if (same == rows.end()) {
      rows.push_back({stage, 1});
      continue;
    }
    ++same->times;
    same->stage.cycles += stage.cycles;
  }
  return rows;
}

std::int64_t channel_bits(const VerifyReport& report, int lanes) {
  std::int64_t bits = 0;
  for (const ChannelReport& channel : report.channels)
    bits += std::int64_t{channel.depth} * channel.bits * lanes;
  return bits;
}

// Sums the units of the whole machine.
Units units_of(const VerifyReport& report, int lanes) {
  Units sum;
  for (const StageReport& stage : report.stages) {
    sum.multipliers += stage.units.multipliers * lanes;
    sum.dividers += stage.units.dividers * lanes;
    sum.random_blocks += stage.units.random_blocks * blocks_of_token(lanes);
  }
  return sum;
}

// Holds what the memory has to give and take in a cycle in which nothing stalls. Traffic that depends on the
// state is the mean over the run.
struct Traffic {
  double read = 0, written = 0, irradiance = 0, falls = 0;
  double total() const { return read + written + irradiance + falls; }
};
json json_of(const Traffic& traffic) {
  return {{"read", traffic.read},
          {"written", traffic.written},
          {"irradiance", traffic.irradiance},
          {"pieces", traffic.falls}};
}
Traffic traffic_of(const VerifyReport& report) {
  Traffic bits;
  for (const StageReport& stage : report.stages) {
    if (stage.cycles.busy == 0) continue;
    const double mean = std::round(ratio(100 * stage.moved_bits, stage.cycles.busy)) / 100;
    if (stage.kind == StageKind::reader) bits.read = mean;
    if (stage.kind == StageKind::writer) bits.written = mean;
    if (stage.kind == StageKind::feed) bits.irradiance += mean;
    if (stage.kind == StageKind::fall_feed) bits.falls = mean;
  }
  return bits;
}

// Returns the prediction, and by how many percent the cycles exceed it.
std::string beside_prediction(std::int64_t cycles, std::int64_t predicted) {
  return fmt::format("{} ({:+.2f} %)", predicted,
                     ratio(100 * (cycles - predicted), std::max<std::int64_t>(1, predicted)));
}

// Returns the text below the table: the whole machine, its bounds, and what it reached.
std::string summary(const VerifyReport& report, const Design& design, const Configuration& configuration) {
  const Shape& shape = design.shape;
  const Units units = units_of(report, configuration.lanes);
  const Traffic traffic = traffic_of(report);
  const int width = shape.tiled() ? shape.blocks() * shape.lanes : shape.grid.x;
  const std::int64_t plane = std::int64_t{width} * shape.grid.y * configuration.cascade;
  std::string text = fmt::format(
      "all lanes and time steps: {} bits of buffers ({:.1f} per cell of a plane and time step), {} "
      "multipliers, {} "
      "dividers, {} random blocks\n",
      buffer_bits(report), ratio(buffer_bits(report), plane), units.multipliers, units.dividers,
      units.random_blocks);

  int highest = 0;
  std::string fullest;
  for (const ChannelReport& channel : report.channels)
    if (!is_feed(channel.producer) && channel.highest > highest) {
      highest = channel.highest;
      fullest = channel.name;
    }
  text += fmt::format("channels: {} of depth {}, {} bits; high-water mark {} ({})\n", report.channels.size(),
                      configuration.fifo_depth, channel_bits(report, configuration.lanes), highest, fullest);
  text += fmt::format(
      "memory traffic, bits per cycle: {:.1f} read + {:.1f} written + {:.1f} irradiance{} = {:.1f}; at 200 "
      "MHz "
      "{:.1f} GB/s\n",
      traffic.read, traffic.written, traffic.irradiance,
      design.parameters.pieces.fall ? fmt::format(" + {:.1f} pieces", traffic.falls) : "", traffic.total(),
      traffic.total() / 8 * 0.2);

  const std::optional<std::int64_t> on_memory = report.predicted_on_memory();
  const auto cells = static_cast<double>(shape.grid.cells()) * report.steps;
  const double per_cycle = ratio(cells, report.cycles);
  const int bound = configuration.lanes * configuration.cascade;
  const std::int64_t offered = shape.tiles() * shape.tokens() * shape.lanes;
  const std::int64_t twice = recomputed_cells(shape);
  if (shape.tiled())
    text += fmt::format(
        "tiles: {} of {} columns, {} of them halo beside each cut; {:.1f} % of the cells are computed "
        "again\n",
        shape.tiles(), width, shape.halo * shape.lanes, ratio(100 * twice, shape.grid.cells()));
  text += fmt::format(
      "cycles: {} in {} passes; predicted without stalls {}{}\n{:.3f} cell-steps per cycle, {:.1f} % of the "
      "bound {} (lanes x cascade); lanes beyond the grid {:.1f} %, time steps without work {:.1f} %\n",
      report.cycles, report.passes, beside_prediction(report.cycles, report.predicted_cycles),
      on_memory ? ", on this memory " + beside_prediction(report.cycles, *on_memory) : "", per_cycle,
      100.0 * per_cycle / bound, bound, 100.0 * (1 - ratio(shape.grid.cells() + twice, offered)),
      100.0 * (1 - ratio(report.steps, report.passes * configuration.cascade)));
  return text +
         fmt::format("simulated, comparing included: {:.2f} million cell-steps a second\n",
                     1e-6 * static_cast<double>(report.cell_steps) / std::max(1e-9, report.model_seconds));
}

}  // namespace

std::optional<std::int64_t> VerifyReport::predicted_on_memory() const {
  std::int64_t all = 0;
  for (const TrainReport& train : trains) {
    if (!train.predicted_on_memory) return std::nullopt;
    all += *train.predicted_on_memory;
  }
  return trains.empty() ? std::nullopt : std::optional(all);
}

json json_of(const VerifyReport& report, const Design& design, const Configuration& configuration) {
  const bool complete = report.mismatch == nullptr;  // otherwise some numbers would be those of half a pass
  json stages = json::array(), channels = json::array();
  for (const StageReport& stage : report.stages) stages.push_back(stage_json(stage));
  for (const ChannelReport& c : report.channels)
    channels.push_back({{"name", c.name},
                        {"depth", c.depth},
                        {"bits", c.bits},
                        {"highest", c.highest},
                        {"occupancy", c.occupancy}});
  const Shape& shape = design.shape;
  const state::Grid g = shape.grid;
  const Units units = units_of(report, configuration.lanes);
  const Traffic traffic = traffic_of(report);
  json result{{"grid", {g.x, g.y, g.z}},
              {"law", design.paper() ? "paper" : "viscous"},
              {"hw", hw_json(configuration)},
              {"tiles",
               {{"count", shape.tiles()},
                {"columns", shape.tiled() ? shape.blocks() * shape.lanes : g.x},
                {"halo", shape.halo * shape.lanes},
                {"recomputed_cells_per_pass", recomputed_cells(shape)}}},
              {"first_step", report.first_step},
              {"steps", report.steps},
              {"compared_cells", report.compared_cells},
              {"software_compared_cells", report.software_cells},
              {"mismatches", complete ? 0 : 1},
              {"first_mismatch", complete ? json() : mismatch_json(*report.mismatch)},
              {"digest", complete ? json(fmt::format("{:016x}", report.digest)) : json()},
              {"passes", report.passes},
              {"cycles", report.cycles},
              {"predicted_cycles", complete ? json(report.predicted_cycles) : json()},
              {"buffer_bits", buffer_bits(report)},
              {"channel_bits", channel_bits(report, configuration.lanes)},
              {"units",
               {{"multipliers", units.multipliers},
                {"dividers", units.dividers},
                {"random_blocks", units.random_blocks}}},
              {"traffic_bits_per_cycle", json_of(traffic)},
              {"simulated_cell_steps", report.cell_steps},
              {"seconds_model", report.model_seconds},
              {"stages", stages},
              {"channels", channels}};
  if (const auto on_memory = report.predicted_on_memory(); complete && on_memory)
    result["predicted_cycles_on_memory"] = *on_memory;
  if (report.irradiance)
    result["irradiance"] = {{"lit_cells", report.irradiance->lit_cells},
                            {"lit_tokens", report.irradiance->lit_tokens},
                            {"stored_bits", report.irradiance->bits}};
  if (report.strike)
    result["planted"] = {{"where", report.strike->where},
                         {"step", report.strike->step},
                         {"cell", {report.strike->x, report.strike->y, report.strike->z}},
                         {"found_there", report.found_where_planted()}};
  add_details(result, report, design, configuration);
  return result;
}

std::string table_of(const VerifyReport& report, const Design& design, const Configuration& configuration) {
  if (report.mismatch != nullptr || report.cycles == 0) return "";  // cycles of half a pass would mislead
  constexpr const char* kLine = "{:<12} {:>5} {:>8} {:>10} {:>10} {:>9} {:>13} {:>11} {:>7} {:>12} {:>13}\n";
  std::string text = fmt::format(kLine, "stage", "times", "busy %", "starved %", "blocked %", "memory %",
                                 "fill/drain %", "bypassed %", "lag", "buffer bits", "mult + div");
  for (const Row& row : rows_of(report.stages)) {
    const StageCycles& c = row.stage.cycles;
    const auto share = [&](std::int64_t cycles) {
      return fmt::format("{:.1f}", ratio(100 * cycles, report.cycles * row.times));
    };
    text += fmt::format(kLine, name_of(row.stage.kind), row.times, share(c.busy), share(c.starved),
                        share(c.blocked), share(c.memory), share(c.fill_drain), share(c.bypassed),
                        row.stage.lag, bits_of(row.stage) * row.times,
                        fmt::format("{} + {}", row.stage.units.multipliers * configuration.lanes * row.times,
                                    row.stage.units.dividers * configuration.lanes * row.times));
  }
  return text + summary(report, design, configuration);
}

}  // namespace voxmelt::hwmodel
