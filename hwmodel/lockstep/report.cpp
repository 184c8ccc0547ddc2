#include "hwmodel/lockstep/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace voxmelt::hwmodel {
namespace {

using json = nlohmann::ordered_json;

json stage_json(const StageReport& stage) {
  json buffers = json::array();
  for (const BufferCost& b : stage.buffers)
    buffers.push_back({{"name", b.name},
                       {"words", b.words},
                       {"lanes", b.lanes},
                       {"bits", b.bits},
                       {"total_bits", b.total()}});
  return {{"name", stage.name},
          {"phase", stage.phase},
          {"cascade", stage.cascade},
          {"lag", stage.lag},
          {"cycles",
           {{"busy", stage.cycles.busy},
            {"starved", stage.cycles.starved},
            {"blocked", stage.cycles.blocked},
            {"fill_drain", stage.cycles.fill_drain}}},
          {"buffers", buffers},
          {"per_lane",
           {{"multipliers", stage.units.multipliers},
            {"dividers", stage.units.dividers},
            {"random_blocks", stage.units.random_blocks}}}};
}

json mismatch_json(const Mismatch& m) {
  return {{"kind", name_of(m.kind)},
          {"where", m.where},
          {"phase", m.phase},
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

// One line per stage: its cycles over all time steps of the cascade together.
struct Row {
  StageReport stage;
  int times = 1;
};
std::vector<Row> rows_of(const std::vector<StageReport>& stages) {
  std::vector<Row> rows;
  for (const StageReport& stage : stages) {
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.stage.name == stage.name; });
    if (same == rows.end()) {
      rows.push_back({stage, 1});
      continue;
    }
    ++same->times;
    StageCycles& sum = same->stage.cycles;
    sum.busy += stage.cycles.busy;
    sum.starved += stage.cycles.starved;
    sum.blocked += stage.cycles.blocked;
    sum.fill_drain += stage.cycles.fill_drain;
  }
  return rows;
}

std::int64_t channel_bits(const VerifyReport& report, int lanes) {
  std::int64_t bits = 0;
  for (const ChannelReport& channel : report.channels)
    bits += std::int64_t{channel.depth} * channel.bits * lanes;
  return bits;
}

}  // namespace

json json_of(const VerifyReport& report, const Design& design, const Configuration& configuration) {
  json stages = json::array(), channels = json::array();
  for (const StageReport& stage : report.stages) stages.push_back(stage_json(stage));
  for (const ChannelReport& c : report.channels)
    channels.push_back({{"name", c.name},
                        {"depth", c.depth},
                        {"bits", c.bits},
                        {"highest", c.highest},
                        {"occupancy", c.occupancy}});
  const state::Grid g = design.shape.grid;
  json result{{"grid", {g.x, g.y, g.z}},
              {"law", design.paper() ? "paper" : "viscous"},
              {"hw",
               {{"lanes", configuration.lanes},
                {"cascade", configuration.cascade},
                {"fifo_depth", configuration.fifo_depth},
                {"stall_seed", configuration.stall_seed}}},
              {"first_step", report.first_step},
              {"steps", report.steps},
              {"compared_cells", report.compared_cells},
              {"software_compared_cells", report.software_cells},
              {"mismatches", report.mismatch == nullptr ? 0 : 1},
              {"first_mismatch", report.mismatch == nullptr ? json() : mismatch_json(*report.mismatch)},
              {"digest", fmt::format("{:016x}", report.digest)},
              {"passes", report.passes},
              {"cycles", report.cycles},
              {"predicted_cycles", report.predicted_cycles},
              {"buffer_bits", buffer_bits(report)},
              {"channel_bits", channel_bits(report, configuration.lanes)},
              {"simulated_cell_steps", report.cell_steps},
              {"seconds_model", report.model_seconds},
              {"stages", stages},
              {"channels", channels}};
  if (report.strike)
    result["planted"] = {{"where", report.strike->where},
                         {"step", report.strike->step},
                         {"cell", {report.strike->x, report.strike->y, report.strike->z}},
                         {"found_there", report.found_where_planted()}};
  return result;
}

std::string table_of(const VerifyReport& report, const Design& design, const Configuration& configuration) {
  const double total = static_cast<double>(std::max<std::int64_t>(1, report.cycles));
  std::string text =
      fmt::format("{:<12} {:>5} {:>8} {:>10} {:>10} {:>13} {:>7} {:>13} {:>13}\n", "stage", "times", "busy %",
                  "starved %", "blocked %", "fill/drain %", "lag", "buffer bits", "mult + div");
  for (const Row& row : rows_of(report.stages)) {
    const auto share = [&](std::int64_t cycles) {
      return fmt::format("{:.1f}", 100.0 * static_cast<double>(cycles) / (total * row.times));
    };
    text += fmt::format("{:<12} {:>5} {:>8} {:>10} {:>10} {:>13} {:>7} {:>13} {:>13}\n", row.stage.name,
                        row.times, share(row.stage.cycles.busy), share(row.stage.cycles.starved),
                        share(row.stage.cycles.blocked), share(row.stage.cycles.fill_drain), row.stage.lag,
                        bits_of(row.stage) * row.times,
                        fmt::format("{} + {}", row.stage.units.multipliers * configuration.lanes * row.times,
                                    row.stage.units.dividers * configuration.lanes * row.times));
  }
  int highest = 0;
  std::string fullest = "none";
  for (const ChannelReport& channel : report.channels)
    if (channel.highest > highest) {
      highest = channel.highest;
      fullest = channel.name;
    }
  const std::int64_t cells = static_cast<std::int64_t>(design.shape.grid.cells()) * report.steps;
  const double bound = static_cast<double>(configuration.lanes) * configuration.cascade;
  text += fmt::format(
      "channels: {} of depth {}, {} bits in all; high-water mark {} ({})\nbuffers: {} bits, {:.1f} per cell "
      "of a "
      "plane and time step\n",
      report.channels.size(), configuration.fifo_depth, channel_bits(report, configuration.lanes), highest,
      fullest, buffer_bits(report),
      static_cast<double>(buffer_bits(report)) /
          (static_cast<double>(design.shape.grid.x) * design.shape.grid.y * configuration.cascade));
  if (report.cycles > 0 && report.mismatch == nullptr)
    text += fmt::format(
        "cycles: {} in {} passes; predicted without stalls {} ({:+.2f} %); {:.3f} cell-steps per cycle, "
        "bound {:.0f} (lanes x cascade), {:.1f} % of it\nsimulated, comparing included: {:.2f} million "
        "cell-steps a second\n",
        report.cycles, report.passes, report.predicted_cycles,
        100.0 * static_cast<double>(report.cycles - report.predicted_cycles) /
            static_cast<double>(std::max<std::int64_t>(1, report.predicted_cycles)),
        static_cast<double>(cells) / total, bound, 100.0 * static_cast<double>(cells) / total / bound,
        1e-6 * static_cast<double>(report.cell_steps) / std::max(1e-9, report.model_seconds));
  return text;
}

}  // namespace voxmelt::hwmodel
