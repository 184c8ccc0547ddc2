#include "app/accuracy_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
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

std::string part(const std::optional<front::Errors>& errors) {
  return errors ? accuracy::percent_text(errors->largest()) : "-";
}

void print_points(const front::Swept& swept) {
  print("{}\n", swept.subject->scene);
  for (const front::Measured& point : swept.points) {
    const auto& baseline = point.cost.baseline_cells_per_second;
    print("  {:<44} {:>10} {:>10} {:>10} {:>10} {:>5} {:>8} {:>9} {:>9}  {}\n", front::text_of(point.choice),
          part(point.arithmetic), part(point.model), part(point.whole), part(point.grid),
          point.cost.state_bits,
          point.cost.run_seconds ? fmt::format("{:.3f} s", *point.cost.run_seconds) : "-",
          accuracy::speed_text(point.cost.cells_per_second), baseline ? accuracy::speed_text(*baseline) : "-",
          point.twin ? "twin" : "engine");
  }
  std::fflush(stdout);
}

}  // namespace

int run_front(const Common& common, const FrontOptions& options, const accuracy::Conditions& conditions) {
  const std::vector<const front::Subject*> subjects = chosen_subjects(options);
  check_report_place(common, options.out);
  std::optional<io::OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);
  end_soon_at_interrupts();

  const auto start = std::chrono::steady_clock::now();
  const front::Extent extent = options.quick ? front::Extent::quick : front::Extent::full;
  accuracy::FrontReport report{.version = "voxmelt " + version_number(),
                               .implementation = conditions.implementation->name,
                               .extent = extent,
                               .swept = {},
                               .seconds = 0};
  print("{:<46} {:>10} {:>10} {:>10} {:>10} {:>5} {:>8} {:>9} {:>9}\n", "", "arithmetic", "model", "whole",
        "grid", "bits", "run", "Mcell/s", "baseline");
  for (const front::Subject* subject : subjects) {
    report.swept.push_back(
        front::sweep(*subject, extent, conditions, [](const front::Choice&) { stop_if_interrupted(); }));
    print_points(report.swept.back());
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print("{} points along {} axes\n", report.points(), report.axes());

  const std::string json = accuracy::json_text(report);
  write_report(common, json);
  if (out) {
    io::write_file(out->partial() / "front.json", json);
    io::write_file(out->partial() / "front.csv", accuracy::csv_text(report));
    io::write_file(out->partial() / "front.md", accuracy::markdown_text(report));
    io::write_file(out->partial() / "front.html", accuracy::html_text(report));
    out->commit();
    if (!common.quiet) print("page, tables and report  {}/\n", seen_from_here(out->place()));
  }
  return kDone;
}

}  // namespace voxmelt::app
