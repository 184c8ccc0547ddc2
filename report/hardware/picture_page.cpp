#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "report/hardware/caster_parts.h"
#include "report/hardware/page.h"
#include "report/hardware/parts.h"
#include "report/svg/svg.h"

namespace voxmelt::hwmodel {

namespace parts {
namespace {

std::string text(const Json& value) { return value.get<std::string>(); }

std::string passes(const Json& report) {
  std::string list;
  for (const Json& pass : report["passes"])
    list += fmt::format("<p class=\"soft\">{}: {} cycles</p>",
                        pass["second"].get<bool>() ? "second pass" : "first pass", number(pass["cycles"]));
  return list;
}

std::string bounds(const Json& json) {
  return "<div class=\"charts\">" +
         roofline({.caption = "What bounds the rays",
                   .unit = "rays",
                   .compute = json["pipes"],
                   .per_byte = json["rays_per_byte"],
                   .bounds = {{json["busiest_stage"], "stage " + text(json["busiest"]) + ", if always busy"},
                              {json["fill_and_drain"], "less its fill and drain"}},
                   .reached = {{json["reached"], json["bytes_per_cycle"], "reached"}},
                   .most_bytes = json["most_bytes_per_cycle"]}) +
         "</div>";
}

std::string caches(const Json& all) {
  std::vector<Bar> rows;
  for (const Json& cache : all) {
    const Json hits = cache["lookups"].get<std::int64_t>() - cache["misses"].get<std::int64_t>();
    const std::string hover =
        fmt::format("{}: {} lookups, {} misses, lines of {} bytes", text(cache["name"]),
                    number(cache["lookups"]), number(cache["misses"]), number(cache["line_bytes"]));
    rows.push_back(
        {text(cache["name"]),
         number(cache["lookups"]),
         {{hits.get<double>(), "busy", hover}, {cache["misses"].get<double>(), "blocked", hover}}});
  }
  return legend({{"busy", "hits"}, {"blocked", "misses"}}) + bars(rows, "caches");
}

std::string dram(const Json& json) {
  const Json& cycles = json["data_bus_cycles"];
  Bar bus{"data bus", number(cycles["all"]), {}};
  std::vector<Key> keys;
  for (const char* name : {"busy", "refresh", "turnaround", "row", "spacing", "idle"}) {
    keys.push_back({name, name});
    bus.segments.push_back(
        {cycles[name].get<double>(), name, fmt::format("{} {} cycles", name, number(cycles[name]))});
  }
  Bar rows{"rows", number(json["activates"]) + " opened", {}};
  const struct {
    const char *key, *css, *name;
  } kinds[] = {
      {"row_hits", "f3", "hits"}, {"row_misses", "f5", "misses"}, {"row_conflicts", "f0", "conflicts"}};
  for (const auto& kind : kinds) {
    keys.push_back({std::string("b") + (kind.css + 1), std::string("row ") + kind.name});
    rows.segments.push_back(
        {json[kind.key].get<double>(), kind.css, fmt::format("{} {}", kind.name, number(json[kind.key]))});
  }
  // Each bar has a scale of its own.
  return legend(keys) + bars({bus}, "data bus") + bars({rows}, "rows") +
         fmt::format(
             "<p class=\"soft\">{} refreshes; a read takes {} cycles of the memory in the mean, {} at "
             "worst.</p>",
             number(json["refreshes"]), number(json["mean_read_cycles"], 1),
             number(json["worst_read_cycles"])) +
         (json["watts"].is_null()
              ? "<p class=\"soft\">Its sheet has no currents, so its energy is unknown.</p>"
              : fmt::format("<p class=\"soft\">It takes {} nJ, which are {} W.</p>",
                            number(json["nanojoules"]["all"]), number(json["watts"], 3)));
}

std::string memories(const Json& pipe) {
  std::vector<Bar> rows;
  for (const Json& memory : pipe["memories"]) {
    const std::string stage = text(memory["stage"]);
    auto row = std::find_if(rows.begin(), rows.end(), [&](const Bar& bar) { return bar.name == stage; });
    if (row == rows.end()) row = rows.insert(rows.end(), {stage, "", {}});
    row->segments.push_back({memory["words"].get<double>() * memory["bits"].get<double>(),
                             fmt::format("f{}", row->segments.size() % 7),
                             fmt::format("{}: {}, {} words of {} bits", stage, text(memory["name"]),
                                         number(memory["words"]), number(memory["bits"]))});
  }
  return bars(rows, "bits of memories");
}

std::string channels(const Json& pipe) {
  std::vector<Bar> rows;
  for (const Json& channel : pipe["channels"])
    rows.push_back({text(channel["name"]),
                    number(channel["bits"]) + " x " + number(channel["depth"]),
                    {{channel["bits"].get<double>() * channel["depth"].get<double>(), "f1",
                      fmt::format("{}: {} bits, depth {}", text(channel["name"]), number(channel["bits"]),
                                  number(channel["depth"]))}}});
  return bars(rows, "bits of channels");
}

}  // namespace

std::string caster_cards(const Json& report) {
  std::string body;
  if (report.contains("stages"))
    body += card("Where the cycles went",
                 "Every cycle of a stage is of one class; memory: it waits for the memory.",
                 bars_of_cycles(report["stages"]));
  if (report.contains("passes"))
    body += card("Predicted against simulated", "The queue model's cycles beside those of the simulation.",
                 passes(report));
  if (report.contains("rays_per_cycle"))
    body += card("Bounds of the ray caster",
                 "The rate cannot lie above any line. Each pipe takes a ray a cycle; the slope is what a "
                 "memory of that width allows.",
                 bounds(report["rays_per_cycle"]));
  if (report.contains("caches"))
    body += card("Caches", "Lookups, on the right, that hit or missed.", caches(report["caches"]));
  if (report.contains("dram"))
    body += card("Memory: " + page::escaped(text(report["dram"]["name"])),
                 page::escaped(text(report["dram"]["title"])), dram(report["dram"]));
  if (!report.contains("pipe")) return body;
  const Json& pipe = report["pipe"];
  body += card("Memories of a pipe", number(pipe["memory_bits"]) + " bits in all, by stage.", memories(pipe));
  return body + card("Channels of a pipe",
                     number(pipe["channel_bits"]) + " bits in all: bits of a token x depth.", channels(pipe));
}

}  // namespace parts

std::string picture_page(const nlohmann::ordered_json& report, const std::string& title) {
  using namespace parts;
  const bool good = report["good"].get<bool>();
  const Json& c = report["configuration"];
  std::string body = fmt::format(
      "<h1>{}</h1>\n<p class=\"lead\">The ray caster in hardware beside the software's picture."
      "</p>\n<div class=\"tally\">{}{}{}{}{}</div>\n",
      page::escaped(title),
      tally(good ? "no difference" : "DIFFERS", number(report["compared_numbers"]) + " numbers compared",
            good ? "good word" : "bad word"),
      tally(number(report["cycles"]), "cycles"), tally(number(report["rays"]), "rays"),
      tally(number(report["memory"]["read_bytes"]), "bytes read"),
      tally(number(report["memory"]["bus_cycles"]), "cycles of the memory's bus"));
  body += fmt::format(
      "<p class=\"soft\">Pipes {}, walkers {}, searchers {}, depth of channels {}, stall seed {}, {} MHz, "
      "memory {}.</p>\n",
      c["pipes"].dump(), c["walkers"].dump(), c["searchers"].dump(), c["fifo_depth"].dump(),
      c["stall_seed"].dump(), c["clock_mhz"].dump(), page::escaped(c["memory"].get<std::string>()));
  if (report.contains("difference")) {
    const Json& d = report["difference"];
    body +=
        card("The first difference", "It ended the run.",
             fmt::format("<pre>stage {}, pixel ({}, {}), sample {}, cycle {}\n{}: expected {}, is {}</pre>",
                         page::escaped(d["stage"].get<std::string>()), d["x"].dump(), d["y"].dump(),
                         d["sample"].dump(), d["cycle"].dump(), page::escaped(d["name"].get<std::string>()),
                         d["expected"].dump(), d["actual"].dump()));
  }
  return page::document(title, parts::kStyle, body + caster_cards(report));
}

}  // namespace voxmelt::hwmodel
