#include "app/accuracy_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/front/sweep.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/print.h"
#include "app/version.h"
#include "kernel/run/io/output_folder.h"
#include "report/accuracy/front.h"
#include "report/accuracy/report.h"

namespace voxmelt::app {
namespace {

namespace front = accuracy::front;

std::vector<const front::Subject*> chosen_subjects(const FrontOptions& options) {
  std::vector<const front::Subject*> chosen;
  for (const front::Subject& one : front::all_subjects()) {
    const bool named =
        std::find(options.scenes.begin(), options.scenes.end(), one.scene) != options.scenes.end();
    const bool in_set = options.scenes.empty() && (!options.quick || one.scene == "bunny");
    if (named || in_set) chosen.push_back(&one);
  }
  for (const std::string& name : options.scenes)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const auto* one) { return one->scene == name; })) {
      std::vector<std::string> known;
      for (const front::Subject& one : front::all_subjects()) known.push_back(one.scene);
      throw UsageError(fmt::format("--front {}: error: not among the scenes of the front: {}", name,
                                   fmt::join(known, ", ")));
    }
  return chosen;
}

void print_points(const front::Swept& swept) {
  print("{}: usual {:.3f} s; other random bits: curves {}, map {}\n", swept.subject->scene,
        swept.usual_seconds, accuracy::percent_text(swept.noise.curves),
        accuracy::percent_text(swept.noise.map));
  for (const front::Measured& point : swept.points)
    print("  {:<11} {:<34} {:>10} {:>10} {:>10.3f} s\n", front::name_of(point.axis),
          front::text_of(point.axis, point.setting) + (point.setting == swept.usual ? " (usual)" : ""),
          point.reference ? "reference" : accuracy::percent_text(point.difference.curves.largest()),
          point.reference ? "" : accuracy::percent_text(point.difference.map), point.seconds);
  for (const front::Pick& pick : swept.picks)
    print("  {:g} %: {}{}, errors {}, {:.3f} s\n", 100 * pick.bound,
          pick.none ? "none" : front::words_of(pick.setting),
          pick.without.empty() ? "" : fmt::format(" (missed by {})", accuracy::axes_text(pick.without)),
          accuracy::percent_text(pick.sum), pick.seconds);
  std::fflush(stdout);
}

void write_files(const std::filesystem::path& folder, const accuracy::FrontReport& report) {
  io::write_file(folder / "front.json", accuracy::json_text(report));
  io::write_file(folder / "front.csv", accuracy::csv_text(report));
  io::write_file(folder / "front.md", accuracy::markdown_text(report));
  io::write_file(folder / "front.html", accuracy::html_text(report));
}

}  // namespace

int run_front(const Common& common, const FrontOptions& options, const accuracy::Conditions& conditions) {
  const std::vector<const front::Subject*> subjects = chosen_subjects(options);
  check_report_place(common, options.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);

  const auto start = std::chrono::steady_clock::now();
  const front::Extent extent = options.quick ? front::Extent::quick : front::Extent::full;
  accuracy::FrontReport report{.version = "voxmelt " + version_number(),
                               .implementation = conditions.implementation->name,
                               .extent = extent,
                               .swept = {},
                               .seconds = 0};
  print("  {:<11} {:<34} {:>10} {:>10} {:>12}\n", "axis", "setting", "curves", "map", "a run");
  for (const front::Subject* subject : subjects) {
    report.swept.push_back(front::sweep(*subject, extent, conditions, stop_if_interrupted));
    print_points(report.swept.back());
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (out) write_files(out->partial(), report);  // a look at the scenes so far
  }
  print("{} points\n", report.points());

  write_report(common, accuracy::json_text(report));
  if (out) {
    out->commit();
    if (!common.quiet) print("page, tables and report  {}/\n", seen_from_here(out->place()));
  }
  return kDone;
}

}  // namespace voxmelt::app
