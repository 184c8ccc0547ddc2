#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure/report.h"

namespace voxmelt::measure {
namespace {

std::string begin(const char* name) { return fmt::format("<!-- table: {} -->\n", name); }
std::string or_dash(const std::optional<double>& value) {
  return value ? three_digits(*value) : std::string("–");
}
std::string percent(const std::optional<double>& value) {
  return value ? fmt::format("{:.0f} %", *value) : std::string("–");
}
std::string ms(double seconds) { return three_digits(seconds * 1e3); }

std::string machine_table(const Findings& findings) {
  const MachineText& m = findings.machine_text;
  std::string text = begin("machine");
  text += fmt::format("{}; {} threads; caches {} (L1), {} (L2), {} (L3); {} of memory.\n\n", m.processor,
                      m.threads, size_text(m.l1_bytes), size_text(m.l2_bytes), size_text(m.l3_bytes),
                      size_text(m.memory_bytes));
  text += "| footprint | threads | copy, GB/s | update in place, GB/s |\n|---|--:|--:|--:|\n";
  for (const auto& [key, found] : findings.machine.bandwidths())
    text += fmt::format("| {} | {} | {} | {} |\n", size_text(key.first), key.second,
                        three_digits(found.copy / 1e9), three_digits(found.update / 1e9));
  text += fmt::format("\n{}", begin("rates"));
  text +=
      "| instruction set | threads | 16-bit multiplies, G lanes/s | 16-bit adds, G lanes/s "
      "|\n|---|--:|--:|--:|\n";
  for (const auto& [key, found] : findings.machine.rates())
    for (const auto& [set, name] : cpu::kInstructionSets)
      if (set == key.first)
        text += fmt::format("| {} | {} | {} | {} |\n", name, key.second, three_digits(found.multiply / 1e9),
                            three_digits(found.add / 1e9));
  return text + "\n";
}

std::string case_table(const Findings& findings, Subject subject) {
  const bool flow = subject == Subject::flow;
  std::string text = begin(flow ? "flow" : "heat");
  text += fmt::format(
      "| case | instruction set | threads | {} | Mcells/s, whole grid | Mcells/s, active | ns per active "
      "cell | "
      "bytes per cell | of the roof | of the roof beside it | x baseline | x native "
      "|\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      flow ? "ms per step: gravity + spread + excess" : "ms per step: heat + melt");
  std::string last;
  for (const Case& one : findings.cases) {
    if (one.subject != subject) continue;
    const auto phase = [&](step::Phase p) { return ms(one.phases.phase[static_cast<std::size_t>(p)]); };
    using enum step::Phase;
    const std::string phases =
        flow ? fmt::format("{} = {} + {} + {}", ms(one.seconds), phase(gravity), phase(spread), phase(excess))
             : fmt::format("{} = {} + {}", ms(one.seconds), phase(heat), phase(melt));
    text += fmt::format(
        "| {} | {} | {} | {} | {:.0f} | {:.0f} | {} | {} | {} | {} | {} | {} |\n",
        one.workload == last ? std::string() : fmt::format("`{}`", one.workload), one.implementation,
        one.threads, phases, one.cells_per_second() / 1e6, one.active_per_second() / 1e6,
        three_digits(1e9 / one.active_per_second()), one.bytes_per_cell, percent(one.percent_of_roof()),
        percent(one.percent_of_roof_beside()), or_dash(one.ratio_to_baseline), or_dash(one.ratio_to_native));
    last = one.workload;
  }
  return text + "\n";
}

std::string paper_table(const Findings& findings) {
  std::string text = begin("paper");
  text +=
      "| scene | grid | who | gravity, ms | spreading, ms | update, ms | frames per second |\n"
      "|---|---|---|--:|--:|--:|--:|\n";
  for (const TableRow& row : findings.table_1)
    text += fmt::format("| {} | {} x {} x {} | {} | {} | {} | {} | {} |\n", row.scene, row.grid.x, row.grid.y,
                        row.grid.z, row.who, three_digits(row.gravity), three_digits(row.spreading),
                        three_digits(row.update), three_digits(row.frames_per_second));
  return text + "\n";
}

std::string scaling_table(const Findings& findings) {
  std::string text = begin("scaling");
  text +=
      "| case | instruction set | threads | speed-up over one | at most: min(threads, ratio of the roofs) |\n"
      "|---|---|--:|--:|--:|\n";
  for (const Scaling& one : findings.scaling)
    text += fmt::format("| `{}` | {} | {} | {:.2f} | {:.2f} |\n", one.workload, one.implementation,
                        one.threads, one.speedup, one.bound);
  return text + "\n";
}

// What is counted for each kind of cell that was timed: a table per subject and law, a column per kind.
struct Kind {
  std::string workloads;
  const Work* work;
};

bool same(const Work& a, const Work& b) {
  return std::equal(a.counts.begin(), a.counts.end(), b.counts.begin(), b.counts.end(),
                    [](const Count& x, const Count& y) { return x.what == y.what; });
}

std::vector<Kind> kinds(const Findings& findings, Subject subject, rule::Law law) {
  std::vector<Kind> result;
  for (const Case& one : findings.cases) {
    if (!one.roof || one.subject != subject || one.law != law) continue;
    const auto known =
        std::find_if(result.begin(), result.end(), [&](const Kind& k) { return same(*k.work, one.work); });
    const std::string name = fmt::format("`{}`", one.workload);
    if (known == result.end())
      result.push_back({name, &one.work});
    else if (known->workloads.find(name) == std::string::npos)
      known->workloads += fmt::format("<br>{}", name);
  }
  return result;
}

// Every term of every kind once, each after the one that it follows in its own kind.
std::vector<std::string> terms(const std::vector<Kind>& kinds) {
  std::vector<std::string> all;
  for (const Kind& kind : kinds) {
    auto place = all.begin();
    for (const Count& count : kind.work->counts) {
      const auto known = std::find(all.begin(), all.end(), count.what);
      place = (known != all.end() ? known : all.insert(place, count.what)) + 1;
    }
  }
  return all;
}

std::string roof_table(const Findings& findings, Subject subject, rule::Law law) {
  const std::vector<Kind> columns = kinds(findings, subject, law);
  if (columns.empty()) return "";
  std::string heading, rule, sums, bytes;
  for (const Kind& kind : columns) {
    heading += fmt::format(" {} |", kind.workloads);
    rule += "--:|";
    sums += fmt::format(" **{} + {}** |", kind.work->multiplies, kind.work->others);
    bytes += fmt::format(" {} |", kind.work->bytes);
  }
  std::string text = fmt::format("| {}{}: multiplies + others |{}\n|---|{}\n", name_of(subject),
                                 subject == Subject::heat  ? ""
                                 : law == rule::Law::paper ? ", paper's law"
                                                           : ", viscous law",
                                 heading, rule);
  for (const std::string& term : terms(columns)) {
    text += fmt::format("| {} |", term);
    for (const Kind& kind : columns) {
      const auto& counts = kind.work->counts;
      const auto count =
          std::find_if(counts.begin(), counts.end(), [&](const Count& c) { return c.what == term; });
      text += count == counts.end() ? std::string(" |")
                                    : fmt::format(" {} + {} |", count->multiplies, count->others);
    }
    text += '\n';
  }
  text += fmt::format("| **in all** |{}\n| bytes |{}\n\nBytes:", sums, bytes);
  for (const Kind& kind : columns) {
    const std::string one = fmt::format(" {}: {}.", kind.work->bytes, kind.work->bytes_text);
    if (text.find(one) == std::string::npos) text += one;
  }
  return text + "\n\n";
}

std::string roof_tables(const Findings& findings) {
  std::string text = begin("roofs");
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    text += roof_table(findings, Subject::flow, law);
  return text + roof_table(findings, Subject::heat, rule::Law::paper);
}

}  // namespace

std::string size_text(std::size_t bytes) {
  if (bytes >= std::size_t{1} << 30) return fmt::format("{:.0f} GiB", static_cast<double>(bytes) / (1 << 30));
  if (bytes >= std::size_t{1} << 20) return fmt::format("{} MiB", bytes >> 20);
  return fmt::format("{} KiB", bytes >> 10);
}

std::string three_digits(double value) {
  if (!std::isfinite(value)) return fmt::format("–");
  const double size = std::abs(value);
  if (size >= 99.95) return fmt::format("{:.0f}", value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.9995) return fmt::format("{:.2f}", value);
  return fmt::format("{:.3f}", value);
}

std::string tables_markdown(const Findings& findings) {
  return machine_table(findings) + case_table(findings, Subject::flow) + case_table(findings, Subject::heat) +
         paper_table(findings) + scaling_table(findings) + roof_tables(findings);
}

}  // namespace voxmelt::measure
