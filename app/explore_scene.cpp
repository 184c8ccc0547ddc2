#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/explore_command.h"
#include "app/interrupt.h"
#include "app/run_ahead.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"

namespace voxmelt::app {
namespace {

// Every design lays out the same state, with its irradiance where that is brightest.
void require_stages_and_room(const hwmodel::explore::Question& question, const std::string& memory) {
  const std::string missing = hwmodel::unmodelled_rule(question.parameters);
  if (!missing.empty()) throw UsageError(fmt::format("error: {}", missing));
  if (!question.memory) return;
  const hwmodel::Design design = hwmodel::design_of(question.parameters, question.grid, {});
  const std::int64_t needed = hwmodel::stream_bytes(design, false), there = question.memory->bytes();
  if (needed > there)
    throw UsageError(
        fmt::format("error: --memory {}: has {} bytes; the pipeline's state and irradiance take up to {}",
                    memory, there, needed));
}

Common with_scene(Common common, const std::string& scene) {
  common.scene = scene;
  return common;
}

}  // namespace

std::optional<hwmodel::memory::Parameters> find_memory(const std::string& name,
                                                       const std::vector<std::string>& sets) {
  if (name == "none") {
    if (!sets.empty())
      throw UsageError(fmt::format("error: --memory none has no number to set ({})", sets.front()));
    return {};
  }
  std::string known = "none";
  bool there = hwmodel::is_memory_file(name);
  for (const hwmodel::MemoryFile& file : hwmodel::memory_files()) {
    there = there || file.name == name;
    known += ", " + file.name;
  }
  if (!there)
    throw UsageError(fmt::format(
        "error: --memory {}: no such memory; there are {}, or a file that ends in .toml, .json or .yaml",
        name, known));
  return hwmodel::load_memory(name, "--memory " + name, sets);
}

ExploreScene::ExploreScene(const ExploreCommand& command, const std::string& given)
    : command_(command), common_(with_scene(command.common, given)), poll_(stop_if_interrupted) {
  question_.device = hwmodel::explore::load_device(command.device, command.device_sets);
  question_.memory = find_memory(command.memory, command.memory_sets);
  question_.steps = command.steps;
  if (question_.device.chain > 1 && command.points > 0 && command.swept.empty())
    throw UsageError(fmt::format("error: device.chain = {}: chains are predicted alone: add --points 0",
                                 question_.device.chain));
  scene_ = load_scene(common_);
  refuse_changes(scene_, "explore");
  keep_inputs(scene_, {{"--report", common_.report}, {"--out", command.out}});
  question_.parameters = scene_.parameters;
  name_ = scene_.name;
  fast_ = &find_phased_implementation(common_);
  tuning_.threads = thread_count(common_);
}

void ExploreScene::begin() {
  ahead_.emplace(run_ahead(scene_, common_, command_.from, command_.steps));
  question_.grid = ahead_->volume().grid;
  require_stages_and_room(question_, command_.memory);
  question_.first_step = ahead_->step_number();
  start_ = ahead_->volume();
  question_.volume = &start_;
  question_.falls = hwmodel::cells_that_fall(question_.parameters, question_.first_step, start_).has_value();
  ahead_->begin_step();  // computes the irradiance of the step
  question_.irradiance = ahead_->irradiance();
  question_.substeps = ahead_->substeps();
}

}  // namespace voxmelt::app
