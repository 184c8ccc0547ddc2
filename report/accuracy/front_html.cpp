// The page of the front first has the table of which setting to take. Then it has a picture and the points of
// each scene.
#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "report/accuracy/front.h"
#include "report/accuracy/front_svg.h"
#include "report/accuracy/front_text.h"
#include "report/accuracy/report.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

using page::escaped;

using front::Axis;
using front::Measured;
using front::Swept;

constexpr const char* kFrontStyle = R"(
th, th:first-child, th:last-child { width: auto; } table { min-width: 0; table-layout: auto; }
.scene { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(430px, 100%), 1fr)); gap: 14px 26px; }
@media (max-width: 600px) { main { padding: 28px 14px 60px; } .card { padding: 18px 14px 12px; } h1 { font-size: 28px; } }
)";

std::size_t colour_of(Axis axis) { return static_cast<std::size_t>(axis); }

std::string html(const FrontTable& table) {
  const auto kind = [&](std::size_t column) { return column < table.texts ? "" : " class=\"n\""; };
  std::string out = "<div class=\"rows\"><table><tr>";
  for (std::size_t i = 0; i < table.head.size(); ++i)
    out += fmt::format("<th{}>{}</th>", kind(i), escaped(table.head[i]));
  out += "</tr>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      out += fmt::format("<td{}>{}</td>", kind(i), escaped(row[i]));
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

// Writes the value alone: "1/2", "8", "0.75".
std::string label_of(const Measured& point) {
  if (point.setting.stages_max > 1)
    return fmt::format("{} of {} stages", point.setting.substeps_max, point.setting.stages_max);
  const std::string text = front::text_of(point.axis, point.setting);
  return text.substr(text.rfind(' ') + 1);
}

std::string figure(const Swept& swept) {
  FrontChart chart{"Error along each axis against the time of a run", "time of a run, seconds (one thread)",
                   "error, %", swept.usual_seconds};
  std::string key;
  const Axis* last = nullptr;
  for (const Measured& point : swept.points) {
    const double error = point.difference.error();
    if (point.axis == Axis::neighbours || point.reference || error == 0) continue;
    chart.dots.push_back({point.seconds, error,
                          fmt::format("{}\nerror {}\n{} a run", front::text_of(point.axis, point.setting),
                                      percent_text(error), seconds_text(point.seconds)),
                          label_of(point), colour_of(point.axis), point.setting.stages_max == 1});
    if (last == nullptr || *last != point.axis)
      key += fmt::format("<span><i class=\"b{}\"></i>{}</span>", colour_of(point.axis),
                         front::name_of(point.axis));
    last = &point.axis;
  }
  return fmt::format(
      "<figure><figcaption>{}</figcaption><div class=\"legend\">{}</div>{}<p class=\"soft\">The upright line "
      "is the usual setting. Errors of two colours have two references.</p></figure>\n",
      chart.title, key, front_svg(chart));
}

std::string scene_card(const Swept& swept) {
  return fmt::format(
      "<section class=\"card\" id=\"{}\"><h3>{}</h3><p>{}</p><div class=\"scene\">{}{}</div></section>\n",
      swept.subject->scene, title_of(swept), escaped(noise_text(swept)), figure(swept),
      html(points_table(swept)));
}

}  // namespace

std::string html_text(const FrontReport& report) {
  std::string scenes, how;
  for (const Swept& swept : report.swept) scenes += scene_card(swept);
  for (const std::string& paragraph : texts_below_picks(report))
    how += fmt::format("<p>{}</p>\n", escaped(paragraph));
  std::string body = fmt::format(
      "<h1>Speed against error</h1>\n<p class=\"soft\">{}</p>\n"
      "<h2>Which setting to take</h2>\n<section class=\"card\">{}</section>\n{}<h2>The scenes</h2>\n{}",
      escaped(about_text(report)), html(picks_table(report)), how, scenes);
  if (const FrontTable formats = formats_table(report); !formats.rows.empty())
    body += fmt::format("<h2>Number formats</h2>\n<section class=\"card\"><p>{}</p>{}</section>\n",
                        escaped(kFormatsText), html(formats));
  return page::document("speed against error", kFrontStyle, body);
}

}  // namespace voxmelt::accuracy
