// `voxmelt explore --sweep KEY=VALUES` tells how the answer follows one number of the device, its family or
// the memory.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/explore_command.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/print.h"
#include "hwmodel/explore/answer.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/explore_report.h"
#include "hwmodel/explore/ranges.h"
#include "hwmodel/explore/values.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;
using json = nlohmann::ordered_json;

struct Row {
  std::string value;
  std::optional<explore::Point> best;
  explore::Ends ends;     // with all numbers at the ends of their ranges
  std::string beyond;     // of the bounds of the closed form
  std::int64_t peak = 0;  // of the memory, MB/s; 0: it always answers
};

explore::Values read_values(const std::string& text) {
  try {
    explore::Values values = explore::values_of(text);
    for (const char* table : {"device.", "family.", "memory."})
      if (values.key.starts_with(table)) return values;
    throw std::invalid_argument(values.key + " is no number of the device, its family or the memory");
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("error: --sweep {}: {}", text, error.what()));
  }
}

ExploreCommand with_value(ExploreCommand command, const explore::Values& values, const std::string& value) {
  const std::string set = values.key + '=' + value;
  (set.starts_with("memory.") ? command.memory_sets : command.device_sets).push_back(set);
  return command;
}

// Reads device and memory with every value, so that a bad one is said at once.
void check_values(const ExploreCommand& asked, const explore::Values& values) {
  for (const std::string& value : values.values) {
    const ExploreCommand command = with_value(asked, values, value);
    explore::load_device(command.device, command.device_sets);
    find_memory(command.memory, command.memory_sets);
  }
}

// Weighs the designs of the highest clock alone: none is slower at a higher clock.
Row row_at(const ExploreScene& scene, const ExploreCommand& asked, const explore::Values& values,
           const std::string& value) {
  const ExploreCommand command = with_value(asked, values, value);
  explore::Question question = scene.question();
  question.device = explore::load_device(command.device, command.device_sets);
  question.memory = find_memory(command.memory, command.memory_sets);
  explore::Axes axes = asked_axes(usual_axes(question), question, command);
  axes.clock_mhz = {axes.clock_mhz.back()};
  const explore::Swept swept = sweep(question, axes, stop_if_interrupted);
  Row row{value, {}, {}, {}, question.memory ? question.memory->peak() : 0};
  if (swept.points.empty()) return row;  // a chain may cut the grid too narrow for any design
  const std::optional<std::size_t> best = explore::best_point(swept);
  if (best) row.best = swept.points[*best];
  row.ends = ranges_of(question, axes, swept, best, stop_if_interrupted).all;
  if (best && question.memory) row.beyond = explore::beyond_bounds(*question.memory, row.best->clock_mhz);
  return row;
}

double giga(const std::optional<explore::Point>& p) { return p ? static_cast<double>(p->speed) * 1e-6 : 0; }

std::string text_of(const Row& row) {
  if (!row.best) return fmt::format("  {:>12}  nothing fits\n", row.value);
  const explore::Point& p = *row.best;
  const double waits = 100. * static_cast<double>(std::max<std::int64_t>(0, p.on_memory - p.cycles)) /
                       static_cast<double>(p.on_memory);
  return fmt::format("  {:>12} {:>9.3f} {:>9.3f} .. {:<9.3f} {:>6.1f} {:<5} {:>6.1f} {:>8}  {}{}\n",
                     row.value, giga(row.best), giga(row.ends.worse), giga(row.ends.better),
                     100 * p.taken.fullest, explore::kResourceNames[p.taken.most], waits,
                     row.peak > 0 ? fmt::format("{:.1f}", static_cast<double>(row.peak) * 1e-3) : "-",
                     design_text(p), row.beyond.empty() ? "" : "; NOT WITHIN ITS BOUNDS: " + row.beyond);
}

std::string table_of(const explore::Values& values, const std::vector<Row>& rows) {
  std::string text =
      fmt::format("  {:>12} {:>9} {:>22} {:>12} {:>6} {:>8}  {}\n", "value", "Gcell/s", "over the ranges",
                  "full %", "waits %", "GB/s", "the best design, predicted");
  for (const Row& row : rows) text += text_of(row);
  return values.key + "\n" + text;
}

std::string csv_of(const explore::Values& values, const std::vector<Row>& rows) {
  std::string text =
      values.key +
      ",cell_steps_per_second,worse,better,lanes,cascade,substeps,fifo_depth,overlap,coded,tile,"
      "clock_mhz,fullest,fullest_of,cycles,cycles_on_memory,within_bounds\n";
  for (const Row& row : rows) {
    text += row.value;
    if (!row.best) {
      text += ",0,,,,,,,,,,,,,,,\n";
      continue;
    }
    const explore::Point& p = *row.best;
    const auto speed = [](const std::optional<explore::Point>& at) { return at ? at->speed * 1000 : 0; };
    text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{:.6f},{},{},{},{}\n", p.speed * 1000,
                        speed(row.ends.worse), speed(row.ends.better), p.hw.lanes, p.hw.cascade,
                        p.hw.substeps, p.hw.fifo_depth, p.hw.overlap ? 1 : 0, p.hw.coded ? 1 : 0, p.hw.tile,
                        p.clock_mhz, p.taken.fullest, explore::kResourceNames[p.taken.most], p.cycles,
                        p.on_memory, row.beyond.empty() ? 1 : 0);
  }
  return text;
}

std::string json_of(const ExploreScene& scene, const ExploreCommand& command, const explore::Values& values,
                    const std::vector<Row>& rows) {
  json list = json::array();
  for (const Row& row : rows)
    list.push_back({{"value", row.value},
                    {"cell_steps_per_second", row.best ? json(row.best->speed * 1000) : json()},
                    {"design", row.best ? json(design_text(*row.best)) : json()},
                    {"worse", row.ends.worse ? json(row.ends.worse->speed * 1000) : json()},
                    {"better", row.ends.better ? json(row.ends.better->speed * 1000) : json()},
                    {"beyond_bounds", row.beyond}});
  const json result{{"scene", scene.name()},  {"device", command.device}, {"memory", command.memory},
                    {"steps", command.steps}, {"key", values.key},        {"rows", list}};
  return result.dump(2) + '\n';
}

}  // namespace

int explore_sweep(const ExploreCommand& command) {
  const Common& common = command.common;
  const explore::Values values = read_values(command.swept);
  ExploreScene scene(command, command.scenes.front());
  check_values(command, values);
  check_report_place(common, command.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!command.out.empty()) out.emplace(command.out);
  scene.begin();
  std::vector<Row> rows;
  for (const std::string& value : values.values) {
    if (!common.quiet) print_error("{} = {}\n", values.key, value);
    rows.push_back(row_at(scene, command, values, value));
  }
  print("{}", table_of(values, rows));
  const std::string json = json_of(scene, command, values, rows);
  write_report(common, json);
  if (out) {
    io::write_file(out->partial() / "sweep.json", json);
    io::write_file(out->partial() / "sweep.csv", csv_of(values, rows));
    out->commit();
    if (!common.quiet) print("table and report  {}/\n", seen_from_here(out->place()));
  }
  return kDone;
}

}  // namespace voxmelt::app
