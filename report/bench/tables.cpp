// The tables here are those of docs/results/performance_tables.md: every case, and the machine's rates that
// they are held against.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

std::string begin(const char* name) { return fmt::format("<!-- table: {} -->\n", name); }

std::string memory_table(const Findings& findings) {
  std::string text =
      begin("memory") + "| footprint | threads | copy, GB/s | update in place, GB/s |\n|---|--:|--:|--:|\n";
  for (const auto& [key, found] : findings.machine.bandwidths())
    text += fmt::format("| {} | {} | {} | {} |\n", size_text(key.first), key.second,
                        three_digits(found.copy / 1e9), three_digits(found.update / 1e9));
  return text + "\n";
}

std::string rates_table(const Findings& findings) {
  std::string text = begin("rates");
  text +=
      "| instruction set | threads | 16-bit multiplies, G lanes/s | 16-bit adds, G lanes/s |\n"
      "|---|--:|--:|--:|\n";
  for (const auto& [key, found] : findings.machine.rates())
    text += fmt::format("| {} | {} | {} | {} |\n", cpu::name_of(key.first), key.second,
                        three_digits(found.multiply / 1e9), three_digits(found.add / 1e9));
  return text + "\n";
}

std::string case_table(const Findings& findings, Subject subject) {
  const bool flow = subject == Subject::flow;
  std::string text = begin(flow ? "flow" : "heat");
  text += fmt::format(
      "| case | instruction set | threads | {} | median | Mcells/s, whole grid | Mcells/s, active | ns per "
      "active "
      "cell | "
      "bytes per cell | of the roof | x baseline | x native | rounds |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      flow ? "ms per step: gravity + spread + excess" : "ms per step: heat + melt");
  std::string last;
  for (const Case& one : findings.cases) {
    if (one.subject != subject) continue;
    const auto phase = [&](step::Phase p) { return milliseconds(one.step.phase[index_of(p)]); };
    using enum step::Phase;
    const std::string phases =
        flow ? fmt::format("{} = {} + {} + {}", milliseconds(one.seconds), phase(gravity), phase(spread),
                           phase(excess))
             : fmt::format("{} = {} + {}", milliseconds(one.seconds), phase(heat), phase(melt));
    text += fmt::format("| {} | {} | {} | {} | {} | {:.0f} | {:.0f} | {} | {} | {} | {} | {} | {} |\n",
                        one.workload == last ? std::string() : fmt::format("`{}`", one.workload),
                        one.implementation, one.threads, phases, milliseconds(one.median_seconds),
                        one.cells_per_second() / 1e6, one.active_per_second() / 1e6,
                        three_digits(1e9 / one.active_per_second()), one.bytes_per_cell,
                        percent_or_dash(one.percent_of_roof()), or_dash(one.ratio_to_baseline),
                        or_dash(one.ratio_to_native), one.rounds);
    last = one.workload;
  }
  return text + "\n";
}

std::string scaling_table(const Findings& findings) {
  std::string text = begin("scaling");
  text +=
      "| case | instruction set | threads | speed-up over one | parallel efficiency |\n"
      "|---|---|--:|--:|--:|\n";
  for (const Scaling& one : findings.scaling)
    text += fmt::format("| `{}` | {} | {} | {:.2f} | {:.0f} % |\n", one.workload, one.implementation,
                        one.threads, one.speedup, 100 * one.efficiency());
  return text + "\n";
}

// Holds the counts of one kind of cell that was timed. A subject and law has a table, with a column per kind.
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

// Lists every term of every kind once, each after the one that it follows in its own kind.
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
  text += fmt::format("| **in all** |{}\n| bytes |{}\n\n| bytes | what they are |\n|--:|---|\n", sums, bytes);
  for (const Kind& kind : columns) {
    const std::string one = fmt::format("| {} | {} |\n", kind.work->bytes, kind.work->bytes_text);
    if (text.find(one) == std::string::npos) text += one;
  }
  return text + "\n";
}

std::string roof_tables(const Findings& findings) {
  std::string text = begin("roofs");
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    text += roof_table(findings, Subject::flow, law);
  return text + roof_table(findings, Subject::heat, rule::Law::paper);
}

}  // namespace

std::string full_tables(const Findings& findings) {
  return memory_table(findings) + rates_table(findings) + case_table(findings, Subject::flow) +
         case_table(findings, Subject::heat) + scaling_table(findings) + roof_tables(findings);
}

}  // namespace voxmelt::measure
