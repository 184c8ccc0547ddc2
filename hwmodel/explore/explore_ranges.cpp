#include "hwmodel/explore/explore_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace voxmelt::hwmodel::explore {
namespace {

double giga(const std::optional<Point>& p) { return p ? static_cast<double>(p->speed) * 1e-6 : 0; }
std::string speed_text(const std::optional<Point>& p) { return fmt::format("{:.3f}", giga(p)); }
std::string design_or_none(const std::optional<Point>& p) { return p ? design_text(*p) : "none fits"; }
std::string short_design(const std::optional<Point>& p) {
  return p ? fmt::format("{} x {}", p->hw.lanes, p->hw.cascade) : "none";
}
std::string kind_of(const std::string& source) { return source.substr(0, source.find_first_of(":,; ")); }

// Returns those that alone change the speed, the widest span first.
std::vector<const Alone*> deciding(const Explored& explored) {
  std::vector<const Alone*> found;
  for (const Alone& alone : explored.ranges.alone)
    if (alone.ends.span() > 0) found.push_back(&alone);
  return found;
}

}  // namespace

std::string ranges_sentence(const Explored& explored) {
  const Ranges& ranges = explored.ranges;
  if (ranges.alone.empty() || !ranges.all.better) return "";
  std::string text =
      fmt::format(" Over the ranges of {} numbers the best design has {} to {} Gcell-steps/s",
                  ranges.alone.size(), speed_text(ranges.all.worse), speed_text(ranges.all.better));
  const std::vector<const Alone*> some = deciding(explored);
  if (some.empty()) return text + ": none of them alone changes it.";
  text += fmt::format(": {} decides most", some[0]->coefficient.name);
  for (std::size_t i = 1; i < std::min<std::size_t>(3, some.size()); ++i)
    text += fmt::format("{}{}", i == 1 ? ", then " : ", ", some[i]->coefficient.name);
  return text + ".";
}

std::string ranges_table(const Explored& explored) {
  const Ranges& ranges = explored.ranges;
  if (ranges.alone.empty()) return "";
  std::string text =
      fmt::format("\nthe best design over the ranges of {} numbers, in {:.2f} s by the closed forms\n",
                  ranges.alone.size(), ranges.seconds);
  const auto all = [&](const char* ends, const std::optional<Point>& point) {
    text += fmt::format("  all at their {} ends  {:>8} Gcell-steps/s: {}\n", ends, speed_text(point),
                        design_or_none(point));
  };
  all("better", ranges.all.better);
  all("worse ", ranges.all.worse);
  const std::vector<const Alone*> some = deciding(explored);
  if (!some.empty())
    text += fmt::format("  {:<34} {:>8} {:>8} {:>8}  {:<12} {:>18}  {}\n", "alone", "is", "better", "worse",
                        "source", "Gcell-steps/s", "lanes x steps");
  for (const Alone* one : some) {
    const Coefficient& c = one->coefficient;
    text += fmt::format("  {:<34} {:>8g} {:>8g} {:>8g}  {:<12} {:>8} .. {}  {} .. {}\n", c.name, c.value,
                        c.better, c.worse, kind_of(c.source), speed_text(one->ends.better),
                        speed_text(one->ends.worse), short_design(one->ends.better),
                        short_design(one->ends.worse));
  }
  text += fmt::format("  {} of them alone change nothing\n", ranges.alone.size() - some.size());
  if (!explored.answer.best) return text;
  const auto losing = std::count_if(ranges.alone.begin(), ranges.alone.end(),
                                    [](const Alone& alone) { return !alone.keeps_best; });
  return text + (ranges.keeps_best
                     ? "  the best design fits with all of them at their worse ends\n"
                     : fmt::format("  the best design does not fit with all at their worse ends, nor "
                                   "with {} of them alone\n",
                                   losing));
}

namespace {

constexpr double kRow = 22, kAbove = 66, kMostRows = 10;
constexpr double kNames = 250, kNotes = 190;  // widths to both sides of the bars

}  // namespace

double ranges_height(const Explored& explored) {
  if (!explored.ranges.all.better) return 0;
  const auto rows = static_cast<double>(deciding(explored).size());
  return kAbove + kRow * (1 + std::min(rows, kMostRows)) + 24;
}

std::string ranges_svg(const Explored& explored, double top, double width) {
  const Ranges& ranges = explored.ranges;
  if (!ranges.all.better) return "";
  const std::vector<const Alone*> some = deciding(explored);
  double fastest = giga(ranges.all.better);
  for (const Alone* one : some) fastest = std::max(fastest, giga(one->ends.better));
  const auto x = [&](double speed) { return kNames + (width - kNames - kNotes) * speed / (1.05 * fastest); };
  double y = kAbove;
  std::string svg = fmt::format(
      "<g transform='translate(0 {})'>\n<text class='title' x='24' y='22'>Best speed over the ranges of {} "
      "numbers, in Gcell-steps/s</text>\n<text x='24' y='42'>From the worse to the better end of all "
      "numbers, and of "
      "each alone; the line is the answer above.</text>\n",
      top, ranges.alone.size());
  const auto bar = [&](const std::string& name, const Ends& ends, const std::string& note, const char* kind) {
    const double from = x(giga(ends.worse)), to = x(giga(ends.better));
    svg += fmt::format(
        "<text class='label' x='{:.0f}' y='{:.0f}' text-anchor='end'>{}</text>"
        "<rect class='{}' x='{:.1f}' y='{:.0f}' width='{:.1f}' height='12'><title>{} to {}</title></rect>"
        "<text x='{:.1f}' y='{:.0f}'>{}</text>\n",
        kNames - 10, y + 11, name, kind, from, y, std::max(1., to - from), speed_text(ends.worse),
        speed_text(ends.better), to + 8, y + 11, note);
    y += kRow;
  };
  bar("all together", ranges.all,
      fmt::format("{} ({}) to {} ({})", speed_text(ranges.all.worse), short_design(ranges.all.worse),
                  speed_text(ranges.all.better), short_design(ranges.all.better)),
      "all");
  for (std::size_t i = 0; i < std::min<std::size_t>(some.size(), static_cast<std::size_t>(kMostRows)); ++i) {
    const Coefficient& c = some[i]->coefficient;
    bar(c.name, some[i]->ends, fmt::format("{:g} to {:g}, {}", c.worse, c.better, kind_of(c.source)),
        "alone");
  }
  if (explored.answer.best) {
    const double at = x(static_cast<double>(explored.swept.points[*explored.answer.best].speed) * 1e-6);
    svg +=
        fmt::format("<line class='limit' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>\n", at, kAbove - 8, y);
  }
  return svg + "</g>\n";
}

}  // namespace voxmelt::hwmodel::explore
