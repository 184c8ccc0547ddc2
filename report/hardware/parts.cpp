#include "report/hardware/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "report/svg/svg.h"

namespace voxmelt::hwmodel::parts {

using page::escaped;

const char* const kStyle = R"(
:root { --rest: #cfcabf; --rest2: #e6e2d9; } @media (prefers-color-scheme: dark) { :root { --rest: #4b515c; --rest2: #333841; } }
.busy { fill: var(--c3); background: var(--c3); } .starved { fill: var(--c1); background: var(--c1); }
.blocked { fill: var(--c0); background: var(--c0); } .memory { fill: var(--c2); background: var(--c2); }
.fill_drain, .fill { fill: var(--rest); background: var(--rest); } .bypassed, .drain { fill: var(--rest2); background: var(--rest2); }
.refresh { fill: var(--c4); background: var(--c4); } .turnaround { fill: var(--c5); background: var(--c5); }
.row { fill: var(--c6); background: var(--c6); } .spacing { fill: var(--c1); background: var(--c1); }
.idle { fill: var(--rest2); background: var(--rest2); }
.wide { overflow-x: auto; } .wide svg { min-width: 640px; }
.over { fill: transparent; } .over:hover { fill: var(--ink); fill-opacity: .18; } .bar:hover { opacity: .75; }
svg .name { font-size: 12px; } .roof { fill: none; stroke: var(--ink); stroke-width: 1.6; }
.dashed { stroke-dasharray: 5 4; fill: none; stroke-width: 1.6; } .dot { stroke: var(--card); stroke-width: 1.5; }
.small { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(210px, 100%), 1fr)); gap: 16px 22px; }
.small figcaption { font-size: 12.5px; font-weight: 600; overflow-wrap: anywhere; } .small p { font-size: 12px; margin: 0; }
.tally b.word { font-size: 22px; line-height: 34px; }
pre { overflow-x: auto; font-size: 13px; line-height: 1.45; margin: 0 0 14px; }
@media (max-width: 600px) { main { padding: 28px 14px 60px; } .card { padding: 18px 14px 12px; } h1 { font-size: 28px; } }
)";

std::string number(const Json& value, int digits) {
  if (!value.is_number()) return "–";
  std::string text = value.is_number_integer() ? std::to_string(value.get<std::int64_t>())
                                               : fmt::format("{:.{}f}", value.get<double>(), digits);
  const std::size_t sign = text[0] == '-' ? 1 : 0, point = std::min(text.find('.'), text.size());
  std::string grouped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > sign && i < point && (point - i) % 3 == 0) grouped += ',';
    grouped += text[i];
  }
  return grouped;
}

std::string tally(const std::string& number, const std::string& what, const char* css) {
  return fmt::format("<div><b class=\"{}\">{}</b><span>{}</span></div>", css, escaped(number), escaped(what));
}

std::string card(const std::string& title, const std::string& about, const std::string& body) {
  return fmt::format("<section class=\"card\"><h3>{}</h3><p>{}</p>{}</section>\n", title, about, body);
}

std::string legend(const std::vector<Key>& keys) {
  std::string out;
  for (const Key& key : keys)
    out += fmt::format("<span><i class=\"{}\"></i>{}</span>", key.css, escaped(key.name));
  return "<div class=\"legend\">" + out + "</div>";
}

std::vector<Key> classes_of(const Json& cycles) {
  static const std::vector<Key> kAll{
      {"busy", "busy"},     {"starved", "starved"},       {"blocked", "blocked"},
      {"memory", "memory"}, {"fill_drain", "fill/drain"}, {"fill", "fill"},
      {"drain", "drain"},   {"bypassed", "bypassed"}};
  std::vector<Key> keys;
  for (const Key& key : kAll)
    if (cycles.contains(key.css)) keys.push_back(key);
  return keys;
}

bool cascaded(const Json& stages) {
  return std::any_of(stages.begin(), stages.end(),
                     [](const Json& stage) { return stage.value("cascade", 0) > 0; });
}

std::string name_of_stage(const Json& stage, bool cascaded) {
  const std::string name = stage["name"].get<std::string>();
  return cascaded ? fmt::format("{}, time step {}", name, stage["cascade"].get<int>()) : name;
}

std::string bars(const std::vector<Bar>& rows, const std::string& label) {
  constexpr double kRight = 890, kWidth = 1000, kLetter = 6.4;
  const double row_height = rows.size() > 30 ? 17 : 24;
  double most = 0, left = 190;
  for (const Bar& row : rows) {
    left = std::max(left, 20 + kLetter * static_cast<double>(row.name.size()));
    double sum = 0;
    for (const Segment& segment : row.segments) sum += segment.value;
    most = std::max(most, sum);
  }
  const double height = row_height * static_cast<double>(rows.size()) + 6;
  std::string svg =
      fmt::format(R"(<div class="wide"><svg viewBox="0 0 {} {:.0f}" role="img" aria-label="{}">)", kWidth,
                  height, escaped(label));
  double y = 3;
  for (const Bar& row : rows) {
    svg += page::text(left - 10, y + row_height / 2 + 4, "end", row.name, "name");
    double x = left;
    for (const Segment& segment : row.segments) {
      const double width = most > 0 ? segment.value / most * (kRight - left) : 0;
      if (width > 0)
        svg += fmt::format(
            R"(<rect class="bar {}" x="{:.2f}" y="{:.1f}" width="{:.2f}" height="{:.1f}"><title>{}</title></rect>)",
            segment.css, x, y + 2, width, row_height - 4, escaped(segment.hover));
      x += width;
    }
    svg += page::text(kWidth, y + row_height / 2 + 4, "end", row.value, "value");
    y += row_height;
  }
  return svg + "</svg></div>";
}

std::string bars_of_cycles(const Json& stages) {
  if (stages.empty()) return "";
  const bool several = cascaded(stages);
  std::vector<Bar> rows;
  for (const Json& stage : stages) {
    const Json& cycles = stage.contains("cycles") ? stage["cycles"] : stage;
    Bar row{name_of_stage(stage, several), "", {}};
    const auto share = [&](const std::string& name) {
      return stage.contains("percent") ? ", " + number(stage["percent"][name], 1) + " %" : "";
    };
    for (const Key& key : classes_of(cycles)) {
      const Json& value = cycles[key.css];
      row.segments.push_back(
          {value.get<double>(), key.css,
           fmt::format("{}: {} {} cycles{}", row.name, key.name, number(value), share(key.css))});
      if (key.css == "busy" && stage.contains("percent"))
        row.value = number(stage["percent"]["busy"], 1) + " %";
    }
    rows.push_back(row);
  }
  const Json& first = stages.front().contains("cycles") ? stages.front()["cycles"] : stages.front();
  return legend(classes_of(first)) + bars(rows, "cycles of every stage by class");
}

}  // namespace voxmelt::hwmodel::parts
