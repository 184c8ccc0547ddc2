// The pictures with axes show activity over time, occupancy, bounds, and predicted against simulated cycles.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "report/hardware/parts.h"
#include "report/svg/axis.h"
#include "report/svg/svg.h"

namespace voxmelt::hwmodel::parts {
namespace {

using page::Axis;
using page::escaped;

constexpr double kWidth = 520, kHeight = 300, kLeft = 74, kRight = 506, kTop = 14, kBottom = 252;

std::string tick_text(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
  return fmt::format("{:g}", value);
}

// Draws both axes with their marks and names.
std::string frame(const Axis& x, const Axis& y, const std::string& x_label, const std::string& y_label) {
  std::string svg;
  for (const double tick : y.ticks()) {
    svg += page::line(kLeft, y(tick), kRight, y(tick), "grid");
    svg += page::text(kLeft - 7, y(tick) + 4, "end", tick_text(tick));
  }
  for (const double tick : x.ticks()) {
    svg += page::line(x(tick), kBottom, x(tick), kBottom + 4, "mark");
    svg += page::text(x(tick), kBottom + 18, "middle", tick_text(tick));
  }
  svg += page::line(kLeft, kBottom, kRight, kBottom, "mark");
  svg += page::text((kLeft + kRight) / 2, kHeight - 8, "middle", x_label, "label");
  return svg +
         fmt::format(
             R"svg(<text class="label" transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
             (kTop + kBottom) / 2, escaped(y_label));
}

std::string dot(double x, double y, const char* css, const std::string& hover) {
  return fmt::format(R"(<circle class="dot {}" cx="{:.1f}" cy="{:.1f}" r="5"><title>{}</title></circle>)",
                     css, x, y, escaped(hover));
}

std::string begin(const std::string& label) {
  return fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kWidth, kHeight, label);
}

// Draws one class of a row of the timeline: a band between two stairs.
std::string band(const std::string& css, const std::vector<double>& x, const std::vector<double>& lower,
                 const std::vector<double>& upper) {
  std::string up, down;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    up += fmt::format("{}{:.1f} {:.1f}H{:.1f}", i == 0 ? "M" : "L", x[i], upper[i], x[i + 1]);
    const std::size_t j = x.size() - 2 - i;
    down += fmt::format("L{:.1f} {:.1f}H{:.1f}", x[j + 1], lower[j], x[j]);
  }
  return fmt::format(R"(<path class="{}" d="{}{}Z"/>)", css, up, down);
}

std::string hover_of(const Json& row, const std::string& name, std::size_t stretch, const Json& begin) {
  std::string text = fmt::format("{}, from cycle {}", name, number(begin));
  for (const Key& key : classes_of(row))
    if (row[key.css][stretch] != 0) text += fmt::format("\n{} {}", key.name, number(row[key.css][stretch]));
  return text;
}

}  // namespace

std::string timeline(const Json& timeline) {
  constexpr double kLeftOfRows = 190, kRightOfRows = 990;
  const Json& stages = timeline["stages"];
  const double row_height = stages.size() > 30 ? 16 : 26;
  const double bottom = row_height * static_cast<double>(stages.size());
  const double end = timeline["end"].get<double>();
  const auto place = [&](double cycle) { return kLeftOfRows + (kRightOfRows - kLeftOfRows) * cycle / end; };
  std::vector<double> x;
  for (const Json& b : timeline["begins"]) x.push_back(place(b.get<double>()));
  x.push_back(place(end));
  const std::size_t n = x.size() - 1;

  std::string svg = fmt::format(
      R"(<div class="wide"><svg viewBox="0 0 1000 {:.0f}" role="img" aria-label="stages over time">)",
      bottom + 44);
  const bool several = cascaded(stages);
  double top = 0;
  for (const Json& row : stages) {
    const std::string name = name_of_stage(row, several);
    svg += page::text(kLeftOfRows - 10, top + row_height / 2 + 4, "end", name, "name");
    const std::vector<Key> classes = classes_of(row);
    std::vector<double> sum(n, 0), lower(n, top + row_height - 1), upper(n);
    for (std::size_t i = 0; i < n; ++i)
      for (const Key& key : classes) sum[i] += row[key.css][i].get<double>();
    for (const Key& key : classes) {
      bool any = false;
      for (std::size_t i = 0; i < n; ++i) {
        const double value = row[key.css][i].get<double>();
        any |= value > 0;
        upper[i] = lower[i] - (sum[i] > 0 ? value / sum[i] * (row_height - 2) : 0);
      }
      if (any) svg += band(key.css, x, lower, upper);
      lower = upper;
    }
    for (std::size_t i = 0; i < n; ++i)
      svg += fmt::format(
          R"(<rect class="over" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"><title>{}</title></rect>)",
          x[i], top + 1, x[i + 1] - x[i], row_height - 2,
          escaped(hover_of(row, name, i, timeline["begins"][i])));
    top += row_height;
  }
  const Axis marks(0, end, false, 0, 1);
  for (const double tick : marks.ticks()) {
    if (tick > end) continue;
    svg += page::line(place(tick), bottom, place(tick), bottom + 4, "mark");
    svg += page::text(place(tick), bottom + 18, "middle", tick_text(tick));
  }
  svg += page::text((kLeftOfRows + kRightOfRows) / 2, bottom + 38, "middle", "cycle", "label");
  return legend(classes_of(stages.front())) + svg + "</svg></div>";
}

std::string histogram(const Json& channel) {
  constexpr double kW = 220, kH = 84, kFloor = 66;
  const auto bins = static_cast<std::size_t>(channel["highest"].get<int>()) + 1;
  double most = 0;
  for (std::size_t i = 0; i < bins; ++i) most = std::max(most, channel["occupancy"][i].get<double>());
  const double step = kW / static_cast<double>(std::max<std::size_t>(bins, 5));
  std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kW, kH,
                                escaped(channel["name"].get<std::string>()));
  svg += page::line(0, kFloor, kW, kFloor, "mark");
  for (std::size_t i = 0; i < bins; ++i) {
    const Json& cycles = channel["occupancy"][i];
    const double high = most > 0 ? cycles.get<double>() / most * (kFloor - 6) : 0;
    const double x = step * static_cast<double>(i);
    if (high > 0)
      svg += fmt::format(
          R"(<rect class="bar busy" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"><title>{} tokens: {} cycles</title></rect>)",
          x + step * 0.1, kFloor - std::max(high, 0.8), step * 0.8, std::max(high, 0.8), i, number(cycles));
    if (bins <= 12 || i % ((bins + 7) / 8) == 0)
      svg += page::text(x + step / 2, kH - 4, "middle", std::to_string(i));
  }
  return fmt::format(
      "<figure><figcaption>{}</figcaption><p class=\"soft\">depth {}, highest {}, {} "
      "bits</p>{}</svg></figure>\n",
      escaped(channel["name"].get<std::string>()), number(channel["depth"]), number(channel["highest"]),
      number(channel["bits"]), svg);
}

std::string roofline(const Roof& roof) {
  const auto real = [](const Json& value) { return value.get<double>(); };
  const auto amount = [&](const Json& value) { return number(value, real(value) < 0.1 ? 3 : 2); };
  const double compute = real(roof.compute), per_byte = real(roof.per_byte);
  double bottom = compute / 16, right = compute / per_byte * 8;
  for (const Roof::Reached& one : roof.reached) {
    bottom = std::min(bottom, real(one.rate) / 3);
    right = std::max(right, real(one.bytes) * 2);
  }
  const Axis x(bottom / per_byte, right, true, kLeft, kRight), y(bottom, compute * 2, true, kBottom, kTop);
  std::string svg = begin("bounds of the rate") +
                    frame(x, y, "bytes that the memory moves in a cycle", roof.unit + " a cycle");
  const double low = std::max(y.low(), x.low() * per_byte);  // the slope's end within the frame
  svg += fmt::format(R"(<path class="roof" d="M{:.1f} {:.1f}L{:.1f} {:.1f}H{:.1f}"><title>{}</title></path>)",
                     x(low / per_byte), y(low), x(compute / per_byte), y(compute), kRight,
                     escaped(fmt::format("{} {} a byte, up to {} a cycle", amount(roof.per_byte), roof.unit,
                                         amount(roof.compute))));
  std::vector<Key> keys{{"line", fmt::format("bandwidth, {} {} a byte; compute, {} a cycle",
                                             amount(roof.per_byte), roof.unit, amount(roof.compute))}};
  const char* const colours[] = {"1", "2", "0"};
  for (std::size_t i = 0; i < roof.bounds.size(); ++i) {
    const Roof::Bound& bound = roof.bounds[i];
    const double value = real(bound.value);
    const std::string colour = colours[i % 3], name = fmt::format("{}: {}", bound.name, amount(bound.value));
    svg += fmt::format(R"(<path class="dashed k{}" d="M{:.1f} {:.1f}H{:.1f}"><title>{}</title></path>)",
                       colour, x(std::max(value / per_byte, x.low())), y(value), kRight, escaped(name));
    keys.push_back({"b" + colour, name});
  }
  if (!roof.most_bytes.is_null()) {
    const double most = real(roof.most_bytes);
    const std::string name =
        fmt::format("the memory moves at most {} bytes a cycle", amount(roof.most_bytes));
    if (most < x.high())
      svg += fmt::format(R"(<path class="dashed k4" d="M{:.1f} {:.1f}V{:.1f}"><title>{}</title></path>)",
                         x(most), kBottom, kTop, escaped(name));
    keys.push_back({"b4", name});
  }
  const char* const dots[] = {"3", "5", "6"};
  for (std::size_t i = 0; i < roof.reached.size(); ++i) {
    const Roof::Reached& one = roof.reached[i];
    const std::string colour = dots[i % 3];
    svg += dot(x(real(one.bytes)), y(real(one.rate)), ("f" + colour).c_str(),
               fmt::format("{}: {} {} a cycle, with {} bytes a cycle", one.name, amount(one.rate), roof.unit,
                           amount(one.bytes)));
    keys.push_back({"b" + colour, fmt::format("{}: {}; it asks for {} bytes a cycle", one.name,
                                              amount(one.rate), amount(one.bytes))});
  }
  return "<figure><figcaption>" + roof.caption + "</figcaption>" + svg + "</svg>" + legend(keys) +
         "</figure>";
}

std::string against_prediction(const Json& trains, const std::vector<std::string>& hover) {
  double low = 0, high = 0;
  const auto predicted = [](const Json& train) {
    return train[train.contains("predicted_cycles_on_memory") ? "predicted_cycles_on_memory"
                                                              : "predicted_cycles"]
        .get<double>();
  };
  for (const Json& train : trains)
    for (const double value : {train["cycles"].get<double>(), predicted(train)}) {
      low = low == 0 ? value : std::min(low, value);
      high = std::max(high, value);
    }
  const bool wide = high > 20 * low;
  const double room = std::max(high - low, 0.1 * high);
  const double from = wide ? low : std::max(0., low - room / 4), to = wide ? high : high + room / 4;
  const Axis x(from, to, wide, kLeft, kRight), y(from, to, wide, kBottom, kTop);
  std::string svg =
      begin("simulated against predicted cycles") + frame(x, y, "predicted cycles", "simulated cycles");
  svg +=
      fmt::format(R"(<path class="exact" d="M{:.1f} {:.1f}L{:.1f} {:.1f}"/>)", kLeft, kBottom, kRight, kTop);
  for (std::size_t i = 0; i < trains.size(); ++i)
    svg += dot(x(predicted(trains[i])), y(trains[i]["cycles"].get<double>()), "f3", hover[i]);
  return "<figure><figcaption>Predicted against simulated</figcaption>" + svg + "</svg>" +
         legend({{"b3", "simulated"}, {"line", "as predicted"}}) + "</figure>";
}

}  // namespace voxmelt::hwmodel::parts
