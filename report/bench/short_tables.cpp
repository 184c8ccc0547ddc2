// The tables here are those of docs/results/performance.md. Most show the widest instruction set on all
// threads.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

std::string machine_text(const Findings& findings) {
  const MachineText& m = findings.machine_text;
  return fmt::format(
      "<!-- table: machine -->\n"
      "{}; {} threads; caches {} (L1), {} (L2), {} (L3); {} of memory.\n"
      "The load average was {:.1f} before the run and {:.1f} after it.\n\n",
      m.processor, m.threads, size_text(m.l1_bytes), size_text(m.l2_bytes), size_text(m.l3_bytes),
      size_text(m.memory_bytes), findings.load_before, findings.load_after);
}

// Returns the last case of each workload. The implementations are timed from the narrowest to the widest,
// each from few threads to many.
std::vector<const Case*> widest(const Findings& findings, std::string_view kind, Subject subject) {
  std::vector<const Case*> result;
  for (const Case& one : findings.cases) {
    if (one.subject != subject || !one.workload.starts_with(kind)) continue;
    if (!result.empty() && result.back()->workload == one.workload)
      result.back() = &one;
    else
      result.push_back(&one);
  }
  return result;
}

std::string caption(const std::vector<const Case*>& cases) {
  if (cases.empty()) return "";
  return fmt::format("Instruction set {}, {}.\n\n", cases.front()->implementation,
                     threads_text(cases.front()->threads));
}

std::string scene_table(const Findings& findings) {
  const std::vector<const Case*> flows = widest(findings, "scene:", Subject::flow);
  const std::vector<const Case*> heats = widest(findings, "scene:", Subject::heat);
  std::string text = "<!-- table: scenes -->\n" + caption(flows);
  text +=
      "| scene | million cells | liquid | flow, ms | x baseline | heat, ms | x baseline |\n"
      "|---|--:|--:|--:|--:|--:|--:|\n";
  for (const Case* flow : flows) {
    const auto heat = std::find_if(heats.begin(), heats.end(),
                                   [&](const Case* one) { return one->workload == flow->workload; });
    const bool hot = heat != heats.end();
    const auto cells = static_cast<double>(flow->cells), liquid = static_cast<double>(flow->active);
    text += fmt::format("| `{}` | {} | {:.1f} % | {} | {} | {} | {} |\n",
                        flow->workload.substr(std::string_view("scene:").size()), three_digits(cells / 1e6),
                        100 * liquid / cells, milliseconds(flow->seconds), or_dash(flow->ratio_to_baseline),
                        hot ? milliseconds((*heat)->seconds) : "–",
                        hot ? or_dash((*heat)->ratio_to_baseline) : "–");
  }
  return text + "\n";
}

std::string dense_table(const Findings& findings) {
  std::string text = "<!-- table: dense -->\n" + caption(widest(findings, "dense:", Subject::flow));
  text +=
      "| subject | volume | ms per step | million cells per second | of the roof | x baseline |\n"
      "|---|---|--:|--:|--:|--:|\n";
  for (const Subject subject : {Subject::flow, Subject::heat})
    for (const Case* one : widest(findings, "dense:", subject))
      text += fmt::format("| {} | `{}` | {} | {:.0f} | {} | {} |\n", name_of(subject), one->workload,
                          milliseconds(one->seconds), one->active_per_second() / 1e6,
                          percent_or_dash(one->percent_of_roof()), or_dash(one->ratio_to_baseline));
  return text + "\n";
}

// Sets the time of flow and heat against the least time, in the scenes that are bounded.
std::string bound_table(const Findings& findings) {
  const std::vector<const Case*> flows = widest(findings, "scene:", Subject::flow);
  std::string text = "<!-- table: bounds -->\n" + caption(flows);
  text +=
      "| scene | subject | vectors that change | ms per step | least, ms | "
      "x baseline | at most |\n"
      "|---|---|--:|--:|--:|--:|--:|\n";
  for (const Subject subject : {Subject::flow, Subject::heat})
    for (const Case* one : widest(findings, "scene:", subject)) {
      if (!one->least_seconds) continue;
      const Needed& needed = *one->needed;
      const std::string vectors = subject == Subject::heat
                                      ? fmt::format("{:.0f}", needed.heat)
                                      : fmt::format("{:.0f}, {:.0f}", needed.gravity, needed.spread);
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n",
                          one->workload.substr(std::string_view("scene:").size()), name_of(subject), vectors,
                          milliseconds(one->seconds), milliseconds(*one->least_seconds),
                          or_dash(one->ratio_to_baseline), or_dash(one->least_ratio_to_baseline()));
    }
  return text + "\n";
}

// Shows the flow of full volumes under the paper's law on one thread, in nanoseconds a cell.
std::string dense_bound_table(const Findings& findings) {
  std::string text = "<!-- table: densebounds -->\n";
  text +=
      "| volume | instruction set | ns a cell | every operation at the rate of multiplies | counted roof |\n"
      "|---|---|--:|--:|--:|\n";
  const auto nanoseconds = [](double per_second) { return three_digits(1e9 / per_second); };
  for (const Case& one : findings.cases)
    if (one.threads == 1 && one.subject == Subject::flow && one.law == rule::Law::paper && one.roof &&
        one.workload.starts_with("dense:"))
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", one.workload, one.implementation,
                          nanoseconds(one.active_per_second()), nanoseconds(one.roof->multiplies),
                          nanoseconds(one.roof->cells()));
  return text + "\n";
}

std::string picture_table(const Findings& findings) {
  std::string text = "<!-- table: picture -->\n";
  text +=
      "| scene | program | gravity, ms | spreading, ms | update, ms | frames per second |\n"
      "|---|---|--:|--:|--:|--:|\n";
  for (const TableRow& row : findings.table_1)
    text += fmt::format("| {}, {} x {} x {} | {} | {} | {} | {} | {} |\n", row.scene, row.grid.x, row.grid.y,
                        row.grid.z, row.program, three_digits(row.gravity), three_digits(row.spreading),
                        three_digits(row.update), three_digits(row.frames_per_second));
  return text + "\n";
}

}  // namespace

std::string short_tables(const Findings& findings) {
  return machine_text(findings) + scene_table(findings) + dense_table(findings) + bound_table(findings) +
         dense_bound_table(findings) + picture_table(findings);
}

}  // namespace voxmelt::measure
