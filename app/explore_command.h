// A command asks `voxmelt explore` for this, about a scene at the step from which a design is sought.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "hwmodel/explore/check.h"
#include "hwmodel/explore/sweep.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct ExploreCommand {
  Common common;
  std::vector<std::string> scenes, compared;  // compared: two reports
  std::string device, memory = "ddr4-2400", out, swept, aim = "sum";
  std::uint32_t steps = 32, from = 0, check_steps = 0;
  std::size_t points = 8;
  bool rtl = false;  // only what `voxmelt rtl` writes
  std::vector<std::string> device_sets, memory_sets, hw_sets;
};

// Returns the memory with the numbers of --set; none if it always answers.
std::optional<hwmodel::memory::Parameters> find_memory(const std::string& name,
                                                       const std::vector<std::string>& sets);

// Returns the axes with what --set and --rtl leave of them. Throws UsageError or scene::InputError.
hwmodel::explore::Axes asked_axes(hwmodel::explore::Axes axes, const hwmodel::explore::Question& question,
                                  const ExploreCommand& command);

// Is a scene that has run to the step from which hardware is weighed. It stays where it is, because its
// question points into it.
class ExploreScene {
 public:
  // Reads the scene, and refuses what cannot be answered. Throws UsageError or scene::InputError.
  ExploreScene(const ExploreCommand& command, const std::string& scene);
  // Runs to the first step. All that follows needs it.
  void begin();
  ExploreScene(const ExploreScene&) = delete;
  ExploreScene& operator=(const ExploreScene&) = delete;

  const std::string& name() const { return name_; }
  const hwmodel::explore::Question& question() const { return question_; }
  hwmodel::explore::CheckInput input() const { return {start_, *fast_, tuning_, poll_}; }

 private:
  const ExploreCommand& command_;
  Common common_;
  scene::Scene scene_;
  std::string name_;
  const step::Implementation* fast_;
  step::Tuning tuning_;
  std::function<void()> poll_;
  std::optional<run::Simulation> ahead_;  // holds the irradiance
  state::Volume start_;
  hwmodel::explore::Question question_;
};

// These are further works of the command. Each returns its exit code.
int explore_batch(const ExploreCommand& command);    // one design for several scenes
int explore_sweep(const ExploreCommand& command);    // one number takes several values
int explore_compare(const ExploreCommand& command);  // what differs between two reports

}  // namespace voxmelt::app
