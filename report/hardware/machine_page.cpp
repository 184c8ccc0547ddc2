#include <fmt/format.h>

#include <string>
#include <vector>

#include "report/hardware/caster_parts.h"
#include "report/hardware/page.h"
#include "report/hardware/parts.h"
#include "report/svg/svg.h"

namespace voxmelt::hwmodel {
namespace {

using namespace parts;

std::string periods(const Json& all) {
  std::vector<Bar> rows;
  for (const Json& json : all) {
    const std::string step = "step " + json["step"].dump();
    const auto part = [](const Json& cycles, const char* css, const char* name) {
      return Segment{cycles.get<double>(), css, fmt::format("{}: {} cycles", name, number(cycles))};
    };
    rows.push_back({step + ", in turn",
                    number(json["cycles_in_turn"]),
                    {part(json["steps"]["cycles_on_memory"], "f3", "pipeline"),
                     part(json["upload"]["cycles"], "f0", "upload"),
                     part(json["frame"]["cycles"], "f1", "ray caster")}});
    rows.push_back(
        {"overlapped",
         number(json["cycles_overlapped"]),
         {part(json["upload"]["cycles"], "f0", "upload"), part(json["together"]["cycles"], "f2", "both")}});
  }
  return legend({{"b3", "pipeline"}, {"b0", "upload"}, {"b1", "ray caster"}, {"b2", "both at once"}}) +
         bars(rows, "cycles of every period");
}

std::string bounds(const Json& all) {
  std::vector<Bar> rows;
  for (const Json& bound : all)
    rows.push_back({bound["name"].get<std::string>(),
                    number(bound["share"]),
                    {{bound["share"].get<double>(), "f3",
                      fmt::format("{}: {} of the overlapped cycles", bound["name"].get<std::string>(),
                                  number(bound["share"], 3))}}});
  return bars(rows, "bounds");
}

std::string one_memory(const Json& json) {
  return "<div class=\"charts\">" +
         roofline(
             {.caption = "What bounds the steps",
              .unit = "cell-steps",
              .compute = json["lanes_and_steps"],
              .per_byte = json["cell_steps_per_byte"],
              .bounds = {{json["always_answered"], "the pipeline on a memory that always answers"}},
              .reached = {{json["alone"], json["bytes_per_cycle_alone"], "the pipeline alone on the memory"},
                          {json["reached"], json["bytes_per_cycle"], "with upload and ray caster"}},
              .most_bytes = json["most_bytes_per_cycle"]}) +
         "</div>";
}

}  // namespace

std::string machine_page(const Json& report, const std::string& title) {
  const bool good = report["good"].get<bool>();
  const Json& rates = report["a_second"];
  std::string body = fmt::format(
      "<h1>{}</h1>\n<p class=\"lead\">The pipeline and the ray caster on one memory, beside the "
      "software.</p>\n"
      "<div class=\"tally\">{}{}{}{}</div>\n<p class=\"soft\">{} steps and {} pictures from step {} on, at "
      "{} MHz.</p>\n",
      page::escaped(title),
      tally(good ? "no difference" : "DIFFERS", number(report["compared_cells"]) + " cells compared",
            good ? "good word" : "bad word"),
      tally(number(rates["overlapped"]["frames"], 1), "frames a second, overlapped"),
      tally(number(rates["in_turn"]["frames"], 1), "frames a second, in turn"),
      tally(number(rates["overlapped"]["steps"], 1), "steps a second, overlapped"), report["steps"].dump(),
      report["frames"].dump(), report["first_step"].dump(), report["clock_mhz"].dump());
  if (!report["periods"].empty()) {
    body += card("Every picture with its steps", "Cycles: one machine after the other, and both at once.",
                 periods(report["periods"]));
    body += card("Bounds", "What share of the overlapped cycles each of these takes at least.",
                 bounds(report["bounds"]));
  }
  if (report.contains("cell_steps_per_cycle"))
    body += card("Two machines on one memory",
                 "The rate of steps cannot lie above any line. The slope is what the bytes of the pipeline "
                 "allow; the ray caster's are beside them.",
                 one_memory(report["cell_steps_per_cycle"]));
  return page::document(title, parts::kStyle, body + caster_cards(report["caster"]));
}

}  // namespace voxmelt::hwmodel
