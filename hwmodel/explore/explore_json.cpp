#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/explore_report.h"

namespace voxmelt::hwmodel::explore {
namespace {

using json = nlohmann::ordered_json;

json amounts_json(const Amounts& amounts) {
  json result;
  for (std::size_t r = 0; r < kResources; ++r) result[std::string(kResourceNames[r])] = amounts[r];
  return result;
}

json logic_json(const LogicCost& cost) {
  return {
      {"lut", cost.lut.value}, {"lut_range", {cost.lut.low, cost.lut.high}}, {"source", cost.lut.source},
      {"ff", cost.ff.value},   {"ff_range", {cost.ff.low, cost.ff.high}},    {"ff_source", cost.ff.source}};
}

json shapes_json(const std::vector<MemoryShape>& shapes) {
  json result = json::array();
  for (const MemoryShape& shape : shapes) result.push_back({shape.bits, shape.words});
  return result;
}

json family_json(const Family& f) {
  json lutram = json::array();
  for (const MemoryShape& shape : f.lutram) lutram.push_back({shape.bits, shape.words, shape.luts});
  json result{{"name", f.name},
              {"bram_parts", f.bram_parts},
              {"byte_bits", f.byte_bits},
              {"part_mux_bits", f.part_mux_bits},
              {"bram_shapes", shapes_json(f.bram)},
              {"uram_shapes", shapes_json(f.uram)},
              {"lutram_shapes", lutram},
              {"mux_ways", f.mux_ways},
              {"deepest_lutram", f.deepest_lutram},
              {"register_words", f.register_words},
              {"product", {f.product.wide, f.product.narrow}},
              {"port_bits", f.port_bits},
              {"port_words", f.port_words},
              {"divider", logic_json(f.divider)},
              {"control", logic_json(f.control)},
              {"random_block", logic_json(f.random_block)},
              {"channel", logic_json(f.channel)},
              {"port", logic_json(f.port)},
              {"coder", logic_json(f.coder)},
              {"base", logic_json(f.base)}};
  for (const auto& [kind, cost] : f.stages) {
    json& stage = result["stages"][std::string(name_of(kind))];
    stage = logic_json(cost.lane);
    stage["multipliers"] = json::array();
    for (const Widths& widths : cost.multipliers)
      stage["multipliers"].push_back({widths.wide, widths.narrow});
    stage["dsp"] = {cost.products, cost.dsps};
  }
  return result;
}

json buffers_json(const std::vector<BufferCost>& buffers) {
  json result = json::array();
  for (const BufferCost& b : buffers)
    result.push_back({{"name", b.name}, {"words", b.words}, {"lanes", b.lanes}, {"bits", b.bits}});
  return result;
}

json parts_json(const PartList& parts) {
  json stages = json::array();
  for (const StagePart& stage : parts.stages) {
    stages.push_back({{"name", name_of(stage.kind)},
                      {"lag", stage.lag},
                      {"output_bits", stage.output_bits},
                      {"buffers", buffers_json(stage.buffers)},
                      {"model_buffers", buffers_json(stage.model_buffers)},
                      {"multipliers", stage.units.multipliers},
                      {"dividers", stage.units.dividers},
                      {"random_blocks_per_8_lanes", stage.units.random_blocks}});
  }
  return {{"lanes", parts.design.shape.lanes},
          {"substeps", parts.design.substeps},
          {"cell_bits", parts.design.cell_bits()},
          {"fed", parts.fed},
          {"tile", parts.design.shape.tiled() ? parts.design.shape.blocks() * parts.design.shape.lanes : 0},
          {"tokens", parts.design.shape.tokens()},
          {"stages", stages}};
}

// Lists the contents of the state with which the run begins, once for each number of lanes.
json contents_json(const std::vector<PartList>& parts) {
  json result = json::array();
  int last = 0;
  for (const PartList& one : parts) {
    const int lanes = one.design.shape.lanes;
    if (lanes == std::exchange(last, lanes)) continue;
    result.push_back({{"lanes", lanes},
                      {"irradiance_bits", one.content->irradiance_bits},
                      {"lit_columns", one.content->lit_columns},
                      {"falls", one.content->falls},
                      {"substeps", one.content->substeps_of(0, 1)},
                      {"coded_bits", one.content->coded_bits},
                      {"coded_columns", one.content->coded_columns}});
  }
  return result;
}

json chain_json(const Device& device) {
  return {{"devices", device.chain},
          {"link_gigabits_per_second", device.link_gbit},
          {"link_nanoseconds", device.link_ns}};
}

json axes_json(const Axes& axes) {
  json result;
  for (const Axis& axis : kAxes) result[std::string(axis.key)] = axes.*axis.values;
  result["tiles"] = axes.tiles;
  result["tile"] = axes.tile ? json(*axes.tile) : json();
  return result;
}

json energy_json(std::int64_t all, std::int64_t memory) {
  return {{"all", all}, {"operations", all - memory}, {"memory", memory}};
}
json energy_json(const Explored& explored, const RunEnergy& energy, const Checked& checked) {
  const auto each = [&](double part) { return per_cell_step(explored.question, checked.steps, part); };
  return energy_json(each(energy.all()), each(energy.memory));
}

json point_json(const Explored& explored, std::size_t at) {
  const Point& p = explored.swept.points[at];
  json hw;
  for (const HwKey& key : kHwKeys)
    if (key.chosen()) hw[std::string(key.name)] = key.get(p.hw);
  hw["clock_mhz"] = p.clock_mhz;
  json result{{"hw", hw},
              {"cycles", p.cycles},
              {"cycles_on_memory", p.on_memory},
              {"cell_steps_per_second", p.speed * 1000},
              {"femtojoules_per_cell_step", energy_json(p.energy, p.memory_energy)},
              {"takes", amounts_json(p.taken.amounts)},
              {"lutram", p.taken.lutram},
              {"fullest", std::isfinite(p.taken.fullest) ? json(p.taken.fullest) : json()},
              {"fullest_of", kResourceNames[p.taken.most]},
              {"state", state_of(checked_at(explored, at))}};
  if (explored.question.memory)
    result["beyond_bounds"] = beyond_bounds(*explored.question.memory, p.clock_mhz);
  const Checked* checked = checked_at(explored, at);
  if (checked == nullptr) return result;
  result["simulated"] = {
      {"steps", checked->steps},
      {"compared_cells", checked->compared_cells},
      {"cycles", checked->cycles},
      {"predicted_cycles", checked->predicted},
      {"cycles_on_memory", checked->on_memory},
      {"predicted_on_memory", checked->predicted_on},
      {"cell_steps_per_second", checked->speed * 1000},
      {"femtojoules_per_cell_step", energy_json(explored, checked->energy, *checked)},
      {"predicted_femtojoules_per_cell_step", energy_json(explored, checked->predicted_energy, *checked)},
      {"error", checked->error()},
      {"allowed_cycles", checked->allowed},
      {"within_bounds", checked->within_bounds()}};
  return result;
}

json next_json(const Explored& explored) {
  const Answer& a = explored.answer;
  json next;
  for (std::size_t r = 0; r < kResources; ++r) {
    json& one = next[std::string(kResourceNames[r])];
    one["limit"] = a.next[r].limit * 1000;
    one["more"] = a.next[r].point ? json(a.next[r].more) : json();
    one["design"] = a.next[r].point ? point_json(explored, *a.next[r].point) : json();
  }
  if (explored.question.memory) next["second_memory"] = a.with_twice_the_memory * 1000;
  next["any_memory"] = a.with_any_memory * 1000;
  next["clock"] = {{"mhz", a.next_clock_mhz}, {"cell_steps_per_second", a.with_next_clock * 1000}};
  return next;
}

json end_json(const std::optional<Point>& point) {
  if (!point) return {};
  json hw;
  for (const HwKey& key : kHwKeys)
    if (key.chosen()) hw[std::string(key.name)] = key.get(point->hw);
  hw["clock_mhz"] = point->clock_mhz;
  return {{"hw", hw}, {"cell_steps_per_second", point->speed * 1000}, {"fullest", point->taken.fullest}};
}

json software_json(const SoftwareRun& run) {
  return {{"implementation", run.implementation},
          {"threads", run.threads},
          {"steps", run.steps},
          {"seconds", run.seconds},
          {"cell_steps_per_second", run.speed * 1000},
          {"compared_steps", run.compared_steps},
          {"digest", fmt::format("{:016x}", run.digest)},
          {"equal", run.equal}};
}

json ends_json(const Ends& ends) {
  return {{"better", end_json(ends.better)}, {"worse", end_json(ends.worse)}};
}

json ranges_json(const Ranges& ranges) {
  json alone = json::array();
  for (const Alone& one : ranges.alone)
    alone.push_back({{"name", one.coefficient.name},
                     {"source", one.coefficient.source},
                     {"value", one.coefficient.value},
                     {"better", one.coefficient.better},
                     {"worse", one.coefficient.worse},
                     {"best", ends_json(one.ends)},
                     {"keeps_best", one.keeps_best}});
  return {{"all", ends_json(ranges.all)},
          {"keeps_best", ranges.keeps_best},
          {"alone", alone},
          {"seconds", ranges.seconds}};
}

}  // namespace

std::string json_of(const Explored& explored) {
  const Question& q = explored.question;
  const rule::Heat& heat = q.parameters.heat;
  json front = json::array(), parts = json::array(), fronts;
  for (const std::size_t at : explored.answer.front) front.push_back(point_json(explored, at));
  for (const PartList& one : explored.swept.parts) parts.push_back(parts_json(one));
  for (std::size_t f = 0; f < kFronts; ++f) {
    json& one = fronts[std::string(front_name(f))] = json::array();
    for (const std::size_t at : explored.answer.fronts[f])
      one.push_back({amount_of(explored.swept.points[at], f), explored.swept.points[at].speed * 1000});
  }
  json result{{"scene", explored.scene},
              {"grid", {q.grid.x, q.grid.y, q.grid.z}},
              {"first_step", q.first_step},
              {"steps", q.steps},
              {"visibility_every", heat.radiates() ? heat.visibility_every : 0},
              {"device", q.device.name},
              {"chain", chain_json(q.device)},
              {"memory", explored.memory},
              {"available", amounts_json(q.device.amounts)},
              {"shell", amounts_json(q.device.shell)},
              {"shell_source", q.device.shell_source},
              {"usable", amounts_json(q.device.usable())},
              {"lutram", q.device.lutram},
              {"clock_mhz", q.device.clock_mhz.value},
              {"clock_range", {q.device.clock_mhz.low, q.device.clock_mhz.high}},
              {"fill", q.device.fill.value},
              {"fill_range", {q.device.fill.low, q.device.fill.high}},
              {"family", family_json(q.device.family)},
              {"axes", axes_json(explored.axes)},
              {"configurations", explored.swept.points.size()},
              {"seconds", explored.swept.seconds},
              {"answer", sentence_of(explored)},
              {"best", explored.answer.best ? point_json(explored, *explored.answer.best) : json()},
              {"frugal", explored.answer.frugal ? point_json(explored, *explored.answer.frugal) : json()},
              {"next", next_json(explored)},
              {"ranges", ranges_json(explored.ranges)},
              {"front", front},
              {"fronts", fronts},
              {"contents", contents_json(explored.swept.parts)},
              {"parts", parts}};
  result["software"] = explored.software ? software_json(*explored.software) : json();
  if (q.memory) {
    const memory::Parameters& m = *q.memory;
    result["dram"] = {{"mhz", m.mhz},
                      {"channels", m.channels},
                      {"peak_megabytes_per_second", m.peak()},
                      {"rfc", m.rfc},
                      {"refi", m.refi},
                      {"rp_all", m.rp_all},
                      {"rp", m.rp},
                      {"rtp", m.rtp},
                      {"rcd", m.rcd},
                      {"cl", m.cl},
                      {"wtr_s", m.wtr_s},
                      {"read_to_write", m.read_to_write},
                      {"interface_cycles", m.interface_cycles}};
  }
  return result.dump(2) + '\n';
}

}  // namespace voxmelt::hwmodel::explore
