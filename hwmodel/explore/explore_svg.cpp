#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/explore/explore_ranges.h"
#include "hwmodel/explore/explore_report.h"
#include "kernel/scene/text/ascii.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr double kWidth = 470, kHeight = 330;                       // size of a panel
constexpr double kLeft = 62, kRight = 18, kTop = 44, kBottom = 46;  // margins of its plot

constexpr const char* kStyle = R"(<style>
svg { color-scheme: light dark; --paper: #fbfaf7; --ink: #1f2328; --soft: #646a73; --line: #e4e1da; --dot: #b9bec6;
  --front: #c8571b; --full: #c23b2a; }
@media (prefers-color-scheme: dark) { svg { --paper: #15171b; --ink: #e6e4df; --soft: #9aa0aa; --line: #31353d;
  --dot: #4b525d; --front: #ff9a5a; --full: #ff7a66; } }
text { font: 12px system-ui, "Noto Sans", "DejaVu Sans", sans-serif; fill: var(--soft); }
.title { font-size: 14px; font-weight: 600; fill: var(--ink); } .head { font-size: 17px; font-weight: 600; fill: var(--ink); }
.page { fill: var(--paper); } .grid { stroke: var(--line); } .dot { fill: var(--dot); }
.dots { stroke: var(--dot); stroke-width: 3.2; stroke-linecap: round; fill: none; }
.front { fill: none; stroke: var(--front); stroke-width: 1.5; opacity: .7; }
.verified { fill: var(--front); } .predicted { fill: var(--paper); stroke: var(--front); stroke-width: 1.5; }
.all { fill: var(--front); } .alone { fill: var(--dot); } .differs, .outside { fill: var(--full); } .limit { stroke: var(--full); stroke-dasharray: 4 4; } .label { fill: var(--ink); }
</style>
)";

// A logarithmic scale has ticks at 1, 2 and 5 times each power of ten.
class Scale {
 public:
  Scale(double low, double high, double from, double to)
      : low_(std::log10(low)), high_(std::log10(std::max(high, low * 1.01))), from_(from), to_(to) {}
  double operator()(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_);
  }
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(low_)); decade <= std::ceil(high_); ++decade)
      for (const double step : {1., 2., 5.}) {
        const double value = step * std::pow(10, decade);
        if (std::log10(value) >= low_ - 1e-9 && std::log10(value) <= high_ + 1e-9) ticks.push_back(value);
      }
    return ticks;
  }

 private:
  double low_, high_, from_, to_;
};

std::string number(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
  return fmt::format("{:g}", value);
}

// Is what an axis shows: its scale is logarithmic, so 0 stands at 1. Energies are shown in picojoules.
double shown_amount(const Point& p, std::size_t front) {
  const auto amount = static_cast<double>(std::max<std::int64_t>(1, amount_of(p, front)));
  return front == kEnergyFront ? amount * 1e-3 : amount;
}

double giga(const Point& p) { return static_cast<double>(p.speed) * 1e-6; }

struct Panel {
  const Explored& explored;
  std::size_t f;  // index into Answer::fronts
  Scale x, y;

  double amount(const Point& p) const { return shown_amount(p, f); }
  std::string at(const Point& p) const { return fmt::format("{:.1f},{:.1f}", x(amount(p)), y(giga(p))); }

  std::string axes(const std::string& name) const {
    std::string text =
        fmt::format("<text class='title' x='{}' y='22'>cell-steps/s against {}</text>\n", kLeft, name);
    for (const double tick : x.ticks())
      text += fmt::format(
          "<line class='grid' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>"
          "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4}</text>\n",
          x(tick), kTop, kHeight - kBottom, kHeight - kBottom + 17, number(tick));
    for (const double tick : y.ticks())
      text += fmt::format(
          "<line class='grid' x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}'/>"
          "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g} G</text>\n",
          kLeft, kWidth - kRight, y(tick), kLeft - 7, y(tick) + 4, tick);
    return text + fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n",
                              (kLeft + kWidth - kRight) / 2, kHeight - 10, name);
  }

  std::string all() const {
    std::set<std::pair<int, int>> seen;  // one dot for designs at one place
    for (const Point& p : explored.swept.points)
      if (p.taken.fits()) seen.emplace(std::lround(x(amount(p))), std::lround(y(giga(p))));
    std::string path;
    for (const auto& [across, down] : seen) path += fmt::format("M{} {}h0", across, down);
    return fmt::format("<path class='dots' d='{}'/>\n", path);
  }

  std::string front() const {
    std::string line, marks;
    for (const std::size_t i : explored.answer.fronts[f]) {
      const Point& p = explored.swept.points[i];
      line += (line.empty() ? "M" : " L") + at(p);
      const Checked* checked = checked_at(explored, i);
      marks += fmt::format(
          "<circle class='{0}' cx='{1:.1f}' cy='{2:.1f}' r='4'><title>{3} lanes x {4} steps, {5} MHz: "
          "{6:.3f} "
          "Gcell-steps/s, {7:.8g} {8}; {0}</title></circle>\n",
          state_of(checked), x(amount(p)), y(giga(p)), p.hw.lanes, p.hw.cascade, p.clock_mhz,
          static_cast<double>(believed_speed(explored, i)) * 1e-6, shown_amount(p, f),
          f == kEnergyFront ? "pJ a cell-step" : front_name(f));
    }
    std::string text = fmt::format("<path class='front' d='{}'/>\n{}", line, marks);
    const auto& front = explored.answer.fronts[f];
    if (front.empty()) return text;
    text += label(explored.swept.points[front.back()], -8);
    if (f == kEnergyFront && front.size() > 1) text += label(explored.swept.points[front.front()], 18);
    return text;
  }

  // Names a design, on that side of it where there is room.
  std::string label(const Point& p, double below) const {
    const bool left = x(amount(p)) > kWidth / 2;
    return fmt::format("<text class='label' x='{:.1f}' y='{:.1f}' text-anchor='{}'>{} x {}, {} MHz</text>\n",
                       x(amount(p)) + (left ? -8 : 8), y(giga(p)) + below, left ? "end" : "start", p.hw.lanes,
                       p.hw.cascade, p.clock_mhz);
  }

  std::string limit(double usable) const {
    return fmt::format(
        "<line class='limit' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>"
        "<text x='{3}' y='22' text-anchor='end'>there are {4}</text>\n",
        x(usable), kTop, kHeight - kBottom, kWidth - kRight, number(usable));
  }
};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return result;
}

std::string name_of(std::size_t front) {
  std::string name(front_name(front));
  for (char& c : name) c = scene::upper_case(c);
  if (front < kResources) return name;
  return front == kClockFront ? "clock, MHz" : "energy, pJ a cell-step";
}

// Returns the right end of an axis: what the device has, or the most that a design takes.
double most_of(const Explored& explored, std::size_t front) {
  if (front < kResources) return static_cast<double>(explored.question.device.usable()[front]);
  if (front == kClockFront) return explored.question.device.clock_mhz.value;
  double most = 0;
  for (const Point& p : explored.swept.points)
    if (p.taken.fits()) most = std::max(most, shown_amount(p, front));
  return most;
}

double top_of(std::size_t panel) {
  const std::size_t row = panel / 2;
  return kHeight * static_cast<double>(row);
}

// Cuts a long text into lines at blanks.
std::string wrapped(const std::string& text, std::size_t most, double x, double y) {
  std::string result;
  for (std::size_t from = 0; from < text.size(); y += 17) {
    std::size_t end = std::min(text.size(), from + most);
    if (end < text.size()) end = std::max(from + 1, text.rfind(' ', end));
    result += fmt::format("<text x='{}' y='{}'>{}</text>\n", x, y, escaped(text.substr(from, end - from)));
    from = end + 1;
  }
  return result;
}

}  // namespace

std::string svg_of(const Explored& explored) {
  const Amounts usable = explored.question.device.usable();
  std::vector<std::size_t> shown;
  for (std::size_t f = 0; f < kFronts; ++f)
    if (f >= kResources || usable[f] > 0) shown.push_back(f);
  double slowest = 1e9, fastest = 0;
  for (const Point& p : explored.swept.points)
    if (p.taken.fits()) {
      slowest = std::min(slowest, giga(p));
      fastest = std::max(fastest, giga(p));
    }
  constexpr double kHead = 121;
  const double panels = kHead + top_of(shown.size() + 1), height = panels + ranges_height(explored);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "role='img'>\n{2}"
      "<rect class='page' width='{0}' height='{1}'/>\n<text class='head' x='24' y='32'>{3} on {4}, "
      "{5}</text>\n{6}",
      2 * kWidth, height, kStyle, escaped(explored.scene), escaped(explored.question.device.name),
      escaped(explored.memory), wrapped(sentence_of(explored), 140, 24, 54));
  if (fastest > 0)
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const std::size_t f = shown[i];
      const double most = most_of(explored, f);
      double least = most;
      for (const std::size_t at : explored.answer.fronts[f])
        least = std::min(least, shown_amount(explored.swept.points[at], f));
      const Panel panel{explored, f, Scale(least * 0.8, most * 1.05, kLeft, kWidth - kRight),
                        Scale(slowest * 0.8, fastest * 1.3, kHeight - kBottom, kTop)};
      svg += fmt::format("<g transform='translate({} {})'>\n{}{}{}{}</g>\n", i % 2 == 0 ? 0 : kWidth,
                         kHead + top_of(i), panel.axes(name_of(f)), panel.all(),
                         f == kEnergyFront ? "" : panel.limit(most), panel.front());
    }
  svg += fmt::format(
      "<circle class='verified' cx='30' cy='105' r='4'/><text x='40' y='109'>verified</text>"
      "<circle class='predicted' cx='110' cy='105' r='4'/><text x='120' y='109'>predicted</text>"
      "<circle class='dot' cx='200' cy='105' r='2'/><text x='208' y='109'>every other design that "
      "fits</text>\n");
  return svg + ranges_svg(explored, panels, 2 * kWidth) + "</svg>\n";
}

}  // namespace voxmelt::hwmodel::explore
