#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/memory/energy.h"
#include "hwmodel/memory/ratio.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

namespace voxmelt::hwmodel {
namespace {

std::string energy_text(const memory::Counts& c, const memory::Parameters& p) {
  if (p.rails.empty()) return "  energy: unknown, the sheet has no currents\n";
  const memory::Energy e = memory::energy_of(c, p);
  const auto part = [&](double energy) { return 100 * ratio(energy, e.all()); };
  return fmt::format(
      "  energy: {:.2f} uJ, {:.3f} W; of it, in %: activate {:.1f}, read {:.1f}, write {:.1f}, refresh "
      "{:.1f}, "
      "background {:.1f}\n",
      1e-3 * e.all(), ratio(e.all(), memory::nanoseconds_of(c, p)), part(e.activate), part(e.read),
      part(e.write), part(e.refresh), part(e.background));
}

nlohmann::ordered_json energy_json(const memory::Counts& c, const memory::Parameters& p) {
  if (p.rails.empty()) return {};
  const memory::Energy e = memory::energy_of(c, p);
  return {{"activate", e.activate},     {"read", e.read}, {"write", e.write}, {"refresh", e.refresh},
          {"background", e.background}, {"all", e.all()}};
}

}  // namespace

std::string memory_text(const memory::Counts& c, const memory::Parameters& p) {
  const std::int64_t requests = c.reads + c.writes;
  const auto part = [&](std::int64_t cycles) { return 100 * ratio(cycles, c.cycles()); };
  const auto in_ns = [&](double cycles) { return cycles * 1000 / p.mhz; };
  return fmt::format("{}: {}; {} bursts of 64 bytes\n", p.name, p.title, requests) +
         fmt::format("  rows: {:.1f} % hits, {:.1f} % misses, {:.1f} % conflicts; {} refreshes\n",
                     100 * ratio(c.hits, requests), 100 * ratio(c.misses, requests),
                     100 * ratio(c.conflicts, requests), c.refreshes) +
         fmt::format(
             "  data bus, in %: busy {:.1f}, idle {:.1f}, refresh {:.1f}, turnaround {:.1f}, row {:.1f}, "
             "spacing {:.1f}\n",
             part(c.busy), part(c.idle), part(c.refresh), part(c.turnaround), part(c.row), part(c.spacing)) +
         fmt::format("  turnarounds: {} to write, {} to read; {} requests waited for one of the same burst\n",
                     c.read_to_write, c.write_to_read, c.held) +
         fmt::format("  a read takes {:.0f} ns in the mean, {:.0f} ns at worst\n",
                     in_ns(ratio(c.read_latency, c.reads)), in_ns(static_cast<double>(c.worst_read))) +
         energy_text(c, p);
}

nlohmann::ordered_json memory_json(const memory::Counts& c, const memory::Parameters& p) {
  return {{"name", p.name},
          {"title", p.title},
          {"mhz", p.mhz},
          {"reads", c.reads},
          {"writes", c.writes},
          {"row_hits", c.hits},
          {"row_misses", c.misses},
          {"row_conflicts", c.conflicts},
          {"activates", c.activates},
          {"precharges", c.precharges},
          {"refreshes", c.refreshes},
          {"turnarounds_to_write", c.read_to_write},
          {"turnarounds_to_read", c.write_to_read},
          {"held_for_order", c.held},
          {"data_bus_cycles",
           {{"busy", c.busy},
            {"idle", c.idle},
            {"refresh", c.refresh},
            {"turnaround", c.turnaround},
            {"row", c.row},
            {"spacing", c.spacing},
            {"all", c.cycles()}}},
          {"mean_read_cycles", ratio(c.read_latency, c.reads)},
          {"worst_read_cycles", c.worst_read},
          {"worst_write_cycles", c.worst_write},
          {"active_rank_cycles", c.active},
          {"nanojoules", energy_json(c, p)},
          {"watts", p.rails.empty() ? nlohmann::ordered_json()
                                    : nlohmann::ordered_json(ratio(memory::energy_of(c, p).all(),
                                                                   memory::nanoseconds_of(c, p)))}};
}

}  // namespace voxmelt::hwmodel
