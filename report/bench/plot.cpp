// The roofline plot is written as SVG by hand: the widest instruction set on one thread. A case stands at the
// operations per byte that the definition needs and at the operations per second that were done. Its number
// leads to its name, its colour tells a scene from a dense volume.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

constexpr double kWidth = 1150, kLeft = 78, kRight = 640, kTop = 76, kBottom = 560, kKey = 780;
constexpr double kFewestOps = 0.25, kMostOps = 64;  // per byte
constexpr double kRadius = 9;
constexpr std::string_view kHalo = " stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\"";

struct Scale {
  double low, high;  // operations per second
  double x(double intensity) const {
    return kLeft + (kRight - kLeft) * std::log(intensity / kFewestOps) / std::log(kMostOps / kFewestOps);
  }
  double y(double rate) const {
    return kBottom - (kBottom - kTop) * std::log(rate / low) / std::log(high / low);
  }
};

constexpr struct {
  std::string_view prefix, what, colour;  // the prefix is that of the workloads' names
} kKinds[] = {{"scene:", "scenes: active cells only", "#b5651d"}, {"dense:", "dense volumes", "#2b5fa8"}};

std::string_view colour(const Case& one) {
  for (const auto& kind : kKinds)
    if (one.workload.starts_with(kind.prefix)) return kind.colour;
  return "#666666";
}

// Returns the widest instruction set: the last one of the run for which the machine's rates are known.
std::string widest(const Findings& findings) {
  std::string result;
  for (const Case& one : findings.cases)
    if (one.roof) result = one.implementation;
  return result;
}

LaneRates rates_of(const Findings& findings, const std::string& implementation) {
  for (const auto& [key, found] : findings.machine.rates())
    if (key.second == 1 && cpu::name_of(key.first) == implementation) return found;
  return {};
}

std::string text(double x, double y, std::string_view anchor, int size, std::string_view fill,
                 const std::string& what, std::string_view more = "") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n", x, y,
      anchor, size, fill, more, what);
}
std::string line(double x1, double y1, double x2, double y2, std::string_view stroke, double width,
                 std::string_view dashes = "") {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
      x1, y1, x2, y2, stroke, width, dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes));
}

std::string axes(const Scale& scale) {
  std::string svg;
  for (double ops = kFewestOps; ops <= kMostOps; ops *= 2) {
    svg += line(scale.x(ops), kTop, scale.x(ops), kBottom, "#e6e6e6", 1);
    svg += text(scale.x(ops), kBottom + 18, "middle", 12, "#333", fmt::format("{:g}", ops));
  }
  for (double rate = scale.low; rate < scale.high * 1.001; rate *= 10)
    for (const double step : {1.0, 2.0, 5.0}) {
      if (rate * step > scale.high * 1.001) break;
      svg += line(kLeft, scale.y(rate * step), kRight, scale.y(rate * step), "#e6e6e6", 1);
      svg += text(kLeft - 8, scale.y(rate * step) + 4, "end", 12, "#333",
                  fmt::format("{:g}", rate * step / 1e9));
    }
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999\"/>\n",
                     kLeft, kTop, kRight - kLeft, kBottom - kTop);
  svg += text((kLeft + kRight) / 2, kBottom + 40, "middle", 13, "#333",
              "16-bit operations that the definition needs, per byte of state");
  svg += text(0, 0, "middle", 13, "#333", "10⁹ such operations done per second, one thread",
              fmt::format(" transform=\"translate(24 {}) rotate(-90)\"", (kTop + kBottom) / 2));
  return svg;
}

std::string roofs(const Findings& findings, const Scale& scale) {
  std::string svg;
  // Slopes are bandwidths on one thread: that of the smallest footprint measured (caches) and that of the
  // largest.
  const std::pair<std::size_t, int>* ends[2] = {nullptr, nullptr};
  for (const auto& [key, found] : findings.machine.bandwidths()) {
    if (key.second != 1) continue;
    if (!ends[0]) ends[0] = &key;
    ends[1] = &key;
  }
  for (const auto* key : ends) {
    if (!key) continue;
    const double rate = findings.machine.bandwidths().at(*key).best();
    const double end = std::min(kMostOps, scale.high / rate), start = std::max(kFewestOps, scale.low / rate);
    if (end <= start) continue;
    svg += line(scale.x(start), scale.y(start * rate), scale.x(end), scale.y(end * rate), "#888", 1.5);
    const double slope =
        -std::atan2(scale.y(start * rate) - scale.y(end * rate), scale.x(end) - scale.x(start));
    const double at = start * 1.7;
    svg +=
        text(0, -5, "middle", 11, "#555", fmt::format("{:.0f} GB/s in {}", rate / 1e9, size_text(key->first)),
             fmt::format(" transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"", scale.x(at),
                         scale.y(at * rate), slope * 180 / std::acos(-1.0)) +
                 std::string(kHalo));
  }
  // Level lines are rates of operations.
  const auto level = [&](double rate, const std::string& what, std::string_view dashes) {
    if (rate <= 0) return;
    svg += line(kLeft, scale.y(rate), kRight, scale.y(rate), "#333", 1.5, dashes);
    svg += text(kRight + 8, scale.y(rate) + 4, "start", 11, "#333", what);
  };
  const std::string set = widest(findings);
  level(rates_of(findings, set).add, set + " additions", "");
  level(rates_of(findings, set).multiply, set + " multiplications", "5 4");
  return svg;
}

double rate_of(const Case& one) { return one.active_per_second() * one.work.operations(); }

// Returns the cases on one thread with the widest instruction set.
std::vector<const Case*> shown_cases(const Findings& findings) {
  const std::string set = widest(findings);
  std::vector<const Case*> shown;
  for (const Case& one : findings.cases)
    if (one.threads == 1 && one.roof && one.implementation == set) shown.push_back(&one);
  return shown;
}

// Makes room for all rates, and for that of additions.
Scale scale_of(const Findings& findings, const std::vector<const Case*>& shown) {
  double low = 1e12, high = std::max(1e9, rates_of(findings, widest(findings)).add);
  for (const Case* one : shown) {
    low = std::min(low, rate_of(*one));
    high = std::max(high, rate_of(*one));
  }
  low = std::pow(10, std::floor(std::log10(low * 0.9)));
  return {low, high * 1.5};
}

// Draws the marks of cases, with their numbers. No mark covers another.
class Marks {
 public:
  explicit Marks(const Scale& scale) : scale_(scale) {}

  void add(const Case& one, std::size_t number) {
    const double x = scale_.x(std::clamp(one.work.operations() / one.work.bytes, kFewestOps, kMostOps));
    const double y = scale_.y(rate_of(one)), best = free_place(x, y);
    placed_.push_back({best, y});
    if (best != x) leaders_ += line(x, y, best, y, "#777", 1);
    marks_ += fmt::format(
        "<g><title>{}: {:.0f} Mcells/s, {:.0f} % of its roof</title><circle cx=\"{:.1f}\" cy=\"{:.1f}\" "
        "r=\"{}\" "
        "fill=\"{}\"/>{}</g>\n",
        one.name, one.active_per_second() / 1e6, *one.percent_of_roof(), best, y, kRadius, colour(one),
        text(best, y + 4, "middle", 11, "#fff", std::to_string(number)));
  }
  std::string svg() const { return leaders_ + marks_; }

 private:
  struct Mark {
    double x, y;
  };
  // Finds a place beside the marks that are there already, as near to its own place as possible.
  double free_place(double x, double y) const {
    double best = x;
    for (int k = 0; k < 60; ++k) {
      const int away = (k + 1) / 2;
      best = x + (k % 2 ? 4.0 : -4.0) * away;
      if (std::none_of(placed_.begin(), placed_.end(),
                       [&](const Mark& m) { return std::hypot(m.x - best, m.y - y) < 2 * kRadius + 1; }))
        break;
    }
    return best;
  }

  const Scale& scale_;
  std::vector<Mark> placed_;
  std::string leaders_, marks_;
};

}  // namespace

std::string roofline_svg(const Findings& findings) {
  const std::vector<const Case*> shown = shown_cases(findings);
  const Scale scale = scale_of(findings, shown);
  Marks marks(scale);
  std::string key_text;
  double key_y = kTop + 14;
  for (std::size_t i = 0; i < shown.size(); ++i, key_y += 17) {
    key_text += text(kKey, key_y, "start", 12, "#222",
                     fmt::format("{}  {} {}", i + 1, name_of(shown[i]->subject), shown[i]->workload));
    marks.add(*shown[i], i + 1);
  }

  const double height = std::max(kBottom + 60, key_y + 90);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\" "
      "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n",
      kWidth, height);
  svg += text(kLeft, 30, "start", 18, "#111", "How near to this machine's limits");
  svg += text(kLeft, 52, "start", 12, "#555",
              findings.machine_text.processor + ", one thread. No point can stand above the solid line.");
  svg += axes(scale) + roofs(findings, scale) + marks.svg() + key_text;
  key_y += 12;
  for (const auto& kind : kKinds) {
    svg += fmt::format("<circle cx=\"{}\" cy=\"{:.1f}\" r=\"6\" fill=\"{}\"/>\n", kKey + 6, key_y - 4,
                       kind.colour);
    svg += text(kKey + 20, key_y, "start", 12, "#222", std::string(kind.what));
    key_y += 18;
  }
  return svg + "</svg>\n";
}

}  // namespace voxmelt::measure
