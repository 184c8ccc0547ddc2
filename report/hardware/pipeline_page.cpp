#include <fmt/format.h>

#include <string>
#include <vector>

#include "report/hardware/page.h"
#include "report/hardware/parts.h"
#include "report/svg/svg.h"

namespace voxmelt::hwmodel {
namespace {

using namespace parts;
using page::escaped;

std::string difference(const Json& report) {
  const Json& m = report["first_mismatch"];
  std::string text = fmt::format(
      "{} ({})\nstep {}, cascade position {}, lane {}, cycle {}, cell ({}, {}, {})\n",
      m["where"].get<std::string>(), m["kind"].get<std::string>(), m["step"].dump(), m["cascade"].dump(),
      m["lane"].dump(), m["cycle"].dump(), m["cell"][0].dump(), m["cell"][1].dump(), m["cell"][2].dump());
  if (!m["field"].get<std::string>().empty())
    text += fmt::format("{}: expected {}, is {}\n", m["field"].get<std::string>(), m["expected"].dump(),
                        m["actual"].dump());
  if (!m["detail"].get<std::string>().empty()) text += m["detail"].get<std::string>() + '\n';
  for (const Json& line : m["neighbourhood"]) text += line.get<std::string>() + '\n';
  return card("The first difference", "What the cells around held before it stands below.",
              "<pre>" + escaped(text) + "</pre>");
}

std::string head(const Json& report, const std::string& title) {
  const Json& hw = report["hw"];
  const bool good = report["mismatches"] == 0;
  std::string body = fmt::format(
      "<h1>{}</h1>\n<p class=\"lead\">The hardware pipeline beside the software.</p>\n", escaped(title));
  body += "<div class=\"tally\">" +
          tally(good ? "no difference" : "DIFFERS", number(report["compared_cells"]) + " cells compared",
                good ? "good word" : "bad word") +
          tally(number(report["cycles"]), "cycles, simulated");
  if (report.contains("predicted_cycles_on_memory"))
    body += tally(number(report["predicted_cycles_on_memory"]), "cycles, predicted on this memory");
  else if (good)
    body += tally(number(report["predicted_cycles"]), "cycles, predicted");
  if (report.contains("cell_steps_per_cycle"))
    body += tally(number(report["cell_steps_per_cycle"]["reached"]), "cell-steps a cycle");
  body += tally(number(report["buffer_bits"]), "bits of buffers") + "</div>\n";
  return body +
         fmt::format(
             "<p class=\"soft\">Grid {} x {} x {}, law {}; lanes {}, cascade {}, depth of channels {}, "
             "stall seed {}, overlap {}; {} passes.</p>\n",
             report["grid"][0].dump(), report["grid"][1].dump(), report["grid"][2].dump(),
             report["law"].get<std::string>(), hw["lanes"].dump(), hw["cascade"].dump(),
             hw["fifo_depth"].dump(), hw["stall_seed"].dump(), hw["overlap"].dump(),
             number(report["passes"]));
}

// On a DRAM the slope is that of the bytes which have moved, and the dot lies there.
std::string bounds_of_rate(const Json& json) {
  const bool dram = json.contains("most_bytes_per_cycle");
  return roofline(
      {.caption = "What bounds the rate",
       .unit = "cell-steps",
       .compute = json["lanes_and_steps"],
       .per_byte = json[dram ? "cell_steps_per_moved_byte" : "cell_steps_per_byte"],
       .bounds = {{json["lanes_in_the_grid"], "less lanes beyond the grid"},
                  {json["steps_with_work"], "less time steps without work"},
                  {json["fill_and_drain"], "less fill and drain"}},
       .reached = {{json["reached"], json[dram ? "moved_bytes_per_cycle" : "bytes_per_cycle"], "reached"}},
       .most_bytes = dram ? json["most_bytes_per_cycle"] : Json{}});
}

std::string charts(const Json& report) {
  std::string figures;
  if (report.contains("cell_steps_per_cycle")) figures += bounds_of_rate(report["cell_steps_per_cycle"]);
  if (!report["trains"].empty()) {
    std::vector<std::string> hover;
    for (const Json& train : report["trains"]) {
      hover.push_back(fmt::format("from step {}, {} passes\nsimulated {}\npredicted {}",
                                  train["first_step"].dump(), train["passes"].dump(), number(train["cycles"]),
                                  number(train["predicted_cycles"])));
      if (train.contains("predicted_cycles_on_memory"))
        hover.back() += " without stalls, " + number(train["predicted_cycles_on_memory"]) + " on this memory";
    }
    figures += against_prediction(report["trains"], hover);
  }
  if (figures.empty()) return "";
  const std::string bounds =
      "The rate cannot lie above any line; the slope is what a memory of that width allows. ";
  return card("Bounds",
              (report.contains("cell_steps_per_cycle") ? bounds : "") + "A dot stands for a train of passes.",
              "<div class=\"charts\">" + figures + "</div>");
}

std::string buffers(const Json& stages) {
  const bool several = cascaded(stages);
  std::vector<Bar> rows;
  for (const Json& stage : stages) {
    if (stage["buffers"].empty()) continue;
    Bar row{name_of_stage(stage, several), number(stage["buffer_bits"]), {}};
    int colour = 0;
    for (const Json& buffer : stage["buffers"])
      row.segments.push_back(
          {buffer["total_bits"].get<double>(), fmt::format("f{}", colour++ % 7),
           fmt::format("{}: {}\n{} words of {} bits, {} lanes: {} bits", row.name,
                       buffer["name"].get<std::string>(), number(buffer["words"]), number(buffer["bits"]),
                       number(buffer["lanes"]), number(buffer["total_bits"]))});
    rows.push_back(row);
  }
  if (rows.empty()) return "";
  return card("Buffers of every stage", "Bits of its memories. What each part is tells the pointer.",
              bars(rows, "bits of buffers"));
}

std::string channels(const Json& report) {
  std::string all;
  for (const Json& channel : report["channels"]) all += histogram(channel);
  return card("Channels", "In how many cycles a channel held how many tokens.",
              "<div class=\"small\">" + all + "</div>");
}

}  // namespace

std::string pipeline_page(const Json& report, const std::string& title) {
  std::string body = head(report, title);
  if (report["mismatches"] != 0) body += difference(report);
  if (report.contains("timeline"))
    body += card("Stages over time", "What share of each stretch of cycles a stage spent on what.",
                 timeline(report["timeline"]));
  body += card("Where the cycles went",
               "Every cycle of a stage is of one class. On the right: the share of busy ones.",
               bars_of_cycles(report["stages"]));
  body += charts(report) + buffers(report["stages"]) + channels(report);
  return page::document(title, parts::kStyle, body);
}

}  // namespace voxmelt::hwmodel
