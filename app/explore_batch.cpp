// `voxmelt explore A B ...` seeks one design for several scenes.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/explore_command.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/print.h"
#include "hwmodel/explore/batch.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;

// All scenes try the lanes, and the steps, that any of them does.
std::vector<explore::Axes> axes_of(const std::vector<std::unique_ptr<ExploreScene>>& scenes,
                                   const ExploreCommand& command) {
  std::set<int> lanes, cascade;
  std::vector<explore::Axes> all;
  for (const auto& scene : scenes) {
    all.push_back(usual_axes(scene->question()));
    lanes.insert(all.back().lanes.begin(), all.back().lanes.end());
    cascade.insert(all.back().cascade.begin(), all.back().cascade.end());
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    all[s].lanes.assign(lanes.begin(), lanes.end());
    all[s].cascade.assign(cascade.begin(), cascade.end());
    all[s] = asked_axes(all[s], scenes[s]->question(), command);
  }
  return all;
}

}  // namespace

int explore_batch(const ExploreCommand& command) {
  const Common& common = command.common;
  std::vector<std::unique_ptr<ExploreScene>> scenes;
  for (const std::string& scene : command.scenes)
    scenes.push_back(std::make_unique<ExploreScene>(command, scene));
  check_report_place(common, command.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!command.out.empty()) out.emplace(command.out);
  for (const auto& scene : scenes) scene->begin();
  const std::vector<explore::Axes> axes = axes_of(scenes, command);
  std::vector<explore::Swept> swept;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!common.quiet) print_error("weighing designs for {}\n", scenes[s]->name());
    swept.push_back(sweep(scenes[s]->question(), axes[s], stop_if_interrupted));
  }
  std::vector<explore::BatchScene> batch_scenes;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    batch_scenes.push_back({scenes[s]->name(), scenes[s]->question(), swept[s]});
  const explore::Aim aim = command.aim == "sum" ? explore::Aim::sum : explore::Aim::worst;
  const explore::Batch batch = batch_of(batch_scenes, aim);
  std::vector<explore::Checked> checked;
  for (std::size_t s = 0; s < scenes.size() && command.points > 0 && !batch.designs.empty(); ++s) {
    if (!common.quiet) print_error("verifying {} of {}: {}\n", s + 1, scenes.size(), scenes[s]->name());
    checked.push_back(check(scenes[s]->question(), swept[s], batch.designs.front().points[s],
                            command.check_steps, scenes[s]->input()));
  }
  print("{}", batch_text(batch_scenes, batch, aim, checked));
  const std::string json = batch_json(batch_scenes, batch, aim, checked);
  write_report(common, json);
  if (out) {
    io::write_file(out->partial() / "explore.json", json);
    io::write_file(out->partial() / "explore.csv", batch_csv(batch_scenes, batch));
    out->commit();
    if (!common.quiet) print("table and report  {}/\n", seen_from_here(out->place()));
  }
  const bool good =
      std::all_of(checked.begin(), checked.end(), [](const auto& one) { return one.verified(); });
  return good ? kDone : kCheckFailed;
}

}  // namespace voxmelt::app
