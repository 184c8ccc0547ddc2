#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/explore_ranges.h"
#include "hwmodel/explore/explore_report.h"
#include "hwmodel/memory/ratio.h"
#include "kernel/scene/text/ascii.h"

namespace voxmelt::hwmodel::explore {
namespace {

double percent(std::int64_t part, std::int64_t whole) { return ratio(100 * part, whole); }
// More of anything need not be used, so it never costs. Speeds are rounded.
double gain(std::int64_t speed, std::int64_t than) {
  return percent(std::max<std::int64_t>(0, speed - than), than);
}
std::string giga(std::int64_t speed) { return fmt::format("{:.3f}", static_cast<double>(speed) * 1e-6); }
// Nanojoules of femtojoules.
std::string nano(std::int64_t energy) { return fmt::format("{:.4f}", static_cast<double>(energy) * 1e-6); }

std::string unit_of(Resource r) {
  std::string name(kResourceNames[r]);
  std::transform(name.begin(), name.end(), name.begin(), scene::upper_case);
  return name;
}

// Says what of a design lies beyond the bounds of the closed form.
std::string beyond_of(const Explored& explored, const Point& p) {
  return explored.question.memory ? beyond_bounds(*explored.question.memory, p.clock_mhz) : "";
}

std::string row_of(const Explored& explored, std::size_t at) {
  const Point& p = explored.swept.points[at];
  std::string text = fmt::format("{:>5} {:>7} {:>8} {:>5} {:>7} {:>5} {:>5} {:>5} {:>9} {:>8}", p.hw.lanes,
                                 p.hw.cascade, p.hw.substeps, p.hw.fifo_depth, p.hw.overlap ? "yes" : "no",
                                 p.hw.coded ? "yes" : "no", p.hw.tile == 0 ? "-" : std::to_string(p.hw.tile),
                                 p.clock_mhz, giga(p.speed), nano(p.energy));
  for (const std::int64_t amount : p.taken.amounts) text += fmt::format(" {:>7}", amount);
  const Fullest& fullest = explored.ranges.fullest[at];
  text += fmt::format(" {:>6.1f} {:>11} {:>7.1f}  ", 100 * p.taken.fullest,
                      fmt::format("{:.0f} .. {:.0f}", 100 * fullest.better, 100 * fullest.worse),
                      percent(std::max<std::int64_t>(0, p.on_memory - p.cycles), p.on_memory));
  const Checked* checked = checked_at(explored, at);
  if (checked == nullptr)
    return text + (beyond_of(explored, p).empty() ? "predicted\n" : "predicted, not within its bounds\n");
  if (!checked->good) return text + "DIFFERS\n";
  return text + fmt::format("{}, {} steps: {}; cycles {:+}, with memory {:+.2f} %\n",
                            checked->within_bounds() ? "verified" : "NOT WITHIN ITS BOUNDS", checked->steps,
                            giga(checked->speed), checked->predicted - checked->cycles,
                            100 * checked->error());
}

// Says what the smallest design lacks, where none fits.
std::string lack_of(const Explored& explored) {
  const std::vector<Point>& points = explored.swept.points;
  const Point& least = *std::min_element(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return std::pair(a.taken.fullest, a.taken.amounts[kLut]) <
           std::pair(b.taken.fullest, b.taken.amounts[kLut]);
  });
  const Device& device = explored.question.device;
  const Amounts usable = device.usable();
  std::string text;
  if (least.taken.lutram > device.lutram)
    text = fmt::format("{} LUT as memory, where {} are usable", least.taken.lutram, device.lutram);
  for (const Resource r : kEachResource)
    if (least.taken.amounts[r] > usable[r])
      text += fmt::format("{}{} {}, where {} are usable", text.empty() ? "" : "; ", least.taken.amounts[r],
                          unit_of(r), usable[r]);
  return fmt::format("The smallest, {}, takes {}.", design_text(least), text);
}

// Lists what would make the best design faster by 1 % and more, the greatest gain first.
std::vector<std::pair<std::int64_t, std::string>> bounds_of(const Explored& explored) {
  const std::int64_t best = explored.swept.points[*explored.answer.best].speed;
  std::vector<std::pair<std::int64_t, std::string>> bounds;
  for (const Resource r : kEachResource)
    if (explored.answer.next[r].limit > best) bounds.emplace_back(explored.answer.next[r].limit, unit_of(r));
  if (explored.answer.with_any_memory > best)
    bounds.emplace_back(explored.answer.with_any_memory, "the memory");
  if (explored.answer.with_next_clock > best)
    bounds.emplace_back(explored.answer.with_next_clock, "the clock");
  std::erase_if(bounds, [&](const auto& bound) { return gain(bound.first, best) < 1; });
  std::stable_sort(bounds.begin(), bounds.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return bounds;
}

std::string devices_of(const Device& device) {
  return device.chain > 1 ? fmt::format("{} x {}", device.chain, device.name) : device.name;
}

// Names the memory with its peak: some are a part of what is sold.
std::string memory_of(const Explored& explored) {
  if (!explored.question.memory) return explored.memory;
  return fmt::format("{} ({:.1f} GB/s)", explored.memory,
                     static_cast<double>(explored.question.memory->peak()) * 1e-3);
}

// Says how fast the best design is, and who says so.
std::string headline_of(const Explored& explored) {
  const Point& p = explored.swept.points[*explored.answer.best];
  const Checked* checked = checked_at(explored, *explored.answer.best);
  if (checked == nullptr) {
    const std::string beyond = beyond_of(explored, p);
    return fmt::format("{} Gcell-steps/s, predicted{}", giga(p.speed),
                       beyond.empty() ? "" : ", NOT WITHIN ITS BOUNDS: " + beyond);
  }
  if (!checked->good) return "but it DIFFERS from the software";
  const std::string simulated =
      fmt::format("{} Gcell-steps/s, simulated over {} step{}", giga(checked->speed), checked->steps,
                  checked->steps == 1 ? "" : "s");
  const std::string predicted =
      fmt::format("predicted {}, {:+.2f} % cycles", giga(checked->predicted_speed), 100 * checked->error());
  if (checked->within_bounds()) return fmt::format("{} and verified, {}", simulated, predicted);
  return fmt::format("{}; the prediction was NOT WITHIN ITS BOUNDS ({}), so another design may be faster",
                     simulated, predicted);
}

std::string next_text(const Explored& explored) {
  const std::int64_t best = explored.swept.points[*explored.answer.best].speed;
  std::string text;
  for (const Resource r : kEachResource) {
    if (explored.question.device.usable()[r] == 0) continue;
    const Next& next = explored.answer.next[r];
    const auto unit = unit_of(r);
    if (next.point)
      text += fmt::format("  {} more {} buy {:+.1f} % ({}); any number {:+.1f} %\n", next.more, unit,
                          gain(explored.swept.points[*next.point].speed, best),
                          design_text(explored.swept.points[*next.point]), gain(next.limit, best));
    else
      text += fmt::format("  more {} alone buy nothing\n", unit);
  }
  if (explored.question.memory)
    text += fmt::format("  a second memory buys {:+.1f} %, any number {:+.1f} %\n",
                        gain(explored.answer.with_twice_the_memory, best),
                        gain(explored.answer.with_any_memory, best));
  return text + fmt::format("  a clock of {} MHz buys {:+.1f} %\n", explored.answer.next_clock_mhz,
                            gain(explored.answer.with_next_clock, best));
}

// Says which design has the most cell-steps per joule, beside the fastest one.
std::string energy_text(const Explored& explored) {
  const auto& points = explored.swept.points;
  const std::size_t frugal = *explored.answer.frugal, best = *explored.answer.best;
  const auto cost_of = [&](std::size_t at) {
    const Point& p = points[at];
    std::string text = fmt::format("{} nJ a cell-step", nano(p.energy));
    if (explored.question.memory)
      text += explored.question.memory->rails.empty()
                  ? fmt::format(" without the memory, whose sheet has no currents")
                  : fmt::format(", {} of them the memory's", nano(p.memory_energy));
    // A femtojoule times a thousand a second is a picowatt.
    return text + fmt::format(", {:.3f} W at {} Gcell-steps/s",
                              1e-12 * static_cast<double>(p.energy) * static_cast<double>(p.speed),
                              giga(p.speed));
  };
  std::string text = fmt::format("  the most frugal design has {}: {:.3f} Gcell-steps per joule, {}\n",
                                 design_text(points[frugal]),
                                 1e6 / static_cast<double>(points[frugal].energy), cost_of(frugal));
  if (frugal != best) text += fmt::format("  the fastest one takes {}\n", cost_of(best));
  return text;
}

// Sets the design beside this machine.
std::string software_text(const Explored& explored) {
  const SoftwareRun& run = *explored.software;
  std::string text = fmt::format(
      "  this machine's software: {} Gcell-steps/s ({}, {} thread{}, {} steps in {:.2f} s)", giga(run.speed),
      run.implementation, run.threads, run.threads == 1 ? "" : "s", run.steps, run.seconds);
  if (explored.answer.best && run.speed > 0)
    text += fmt::format("; the best design is {:.1f} times as fast",
                        ratio(believed_speed(explored, *explored.answer.best), run.speed));
  if (run.compared_steps > 0)
    text += run.equal
                ? fmt::format("; after {} steps its bits are those of the pipeline", run.compared_steps)
                : fmt::format("; after {} steps its bits are NOT those of the pipeline", run.compared_steps);
  return text + "\n";
}

}  // namespace

std::string design_text(const Point& p) {
  std::string text = fmt::format("{} lanes x {} steps at {} MHz", p.hw.lanes, p.hw.cascade, p.clock_mhz);
  if (p.hw.substeps > 1) text += fmt::format(", {} sub-steps", p.hw.substeps);
  if (p.hw.coded) text += ", coded";
  if (p.hw.tile > 0) text += fmt::format(", tiles of {} columns", p.hw.tile);
  return text;
}

const Checked* checked_at(const Explored& explored, std::size_t point) {
  for (const Checked& checked : explored.checked)
    if (checked.point == point) return &checked;
  return nullptr;
}

std::string_view state_of(const Checked* checked) {
  if (checked == nullptr) return "predicted";
  if (!checked->good) return "differs";
  return checked->within_bounds() ? "verified" : "outside";
}

std::int64_t believed_speed(const Explored& explored, std::size_t point) {
  const Checked* checked = checked_at(explored, point);
  return checked != nullptr && checked->good ? checked->speed : explored.swept.points[point].speed;
}

std::string sentence_of(const Explored& explored) {
  const Device& device = explored.question.device;
  if (!explored.answer.best)
    return fmt::format("None of {} designs for {} fits on {}. {}", explored.swept.points.size(),
                       explored.scene, device.name, lack_of(explored));
  const Point& p = explored.swept.points[*explored.answer.best];
  const auto bounds = bounds_of(explored);
  std::string text = fmt::format("The best of {} designs for {} on {} with {} has {}: {}; ",
                                 explored.swept.points.size(), explored.scene, devices_of(device),
                                 memory_of(explored), design_text(p), headline_of(explored));
  if (bounds.empty()) return text + "no resource alone bounds it." + ranges_sentence(explored);
  text += bounds.front().second + " bounds it";
  for (std::size_t i = 1; i < bounds.size(); ++i) text += (i == 1 ? ", then " : ", ") + bounds[i].second;
  return text + "." + ranges_sentence(explored);
}

std::string text_of(const Explored& explored) {
  const Device& device = explored.question.device;
  const Amounts usable = device.usable();
  std::string text = fmt::format("{}, of which usable:", device.title);
  for (const Resource r : kEachResource) text += fmt::format(" {} {}", usable[r], unit_of(r));
  if (!device.shell_source.empty())
    text += fmt::format("\nthe shell takes its part: {}", device.shell_source);
  if (device.chain > 1)
    text += fmt::format(
        "\n{} of them in a chain: each has a tile of the grid and a memory; links of {} Gbit/s and {} ns",
        device.chain, device.link_gbit, device.link_ns);
  text +=
      fmt::format("\nmemory: {}\n{} designs of {} steps in {:.2f} s by the closed forms; {} on the front\n",
                  explored.question.memory ? explored.question.memory->title : "always answers",
                  explored.swept.points.size(), explored.question.steps, explored.swept.seconds,
                  explored.answer.front.size());
  text += fmt::format("{:>5} {:>7} {:>8} {:>5} {:>7} {:>5} {:>5} {:>5} {:>9} {:>8}", "lanes", "cascade",
                      "substeps", "depth", "overlap", "coded", "tile", "MHz", "Gcell/s", "nJ");
  for (const Resource r : kEachResource) text += fmt::format(" {:>7}", unit_of(r));
  text += fmt::format(" {:>6} {:>11} {:>7}\n", "full %", "range %", "waits %");
  for (const std::size_t at : explored.answer.front) text += row_of(explored, at);
  for (const Checked& checked : explored.checked)
    if (!checked.good) text += checked.difference;
  text += sentence_of(explored) + "\n";
  if (explored.answer.best) text += next_text(explored) + energy_text(explored);
  if (explored.software) text += software_text(explored);
  return text + ranges_table(explored);
}

}  // namespace voxmelt::hwmodel::explore
