// A trial is one run of a case: a committed scene, its start state, and how fast it ran.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/case.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::accuracy {

// Returns the step that is nearest to a time in steps.
inline std::uint32_t step_at(double time) { return static_cast<std::uint32_t>(std::lround(time)); }

class Trial {
 public:
  using Fill = std::function<void(state::Volume& empty)>;

  // Runs `scene`, a file of the cases' folder without its suffix. Each of `sets` is "path.to.key=value", as
  // of --set. `fill` writes the start state into an empty grid. Without it the scene's own shapes are the
  // start. Throws scene::InputError if the scene is refused.
  Trial(const Conditions& conditions, const std::string& scene, std::vector<std::string> sets,
        const Fill& fill = {});

  void run_to(std::uint32_t step);  // steps done since the start
  std::uint32_t steps() const { return simulation_->steps_done(); }
  const state::Volume& volume() const { return simulation_->volume(); }
  const run::Simulation& simulation() const { return *simulation_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  // Returns the steps from `from` to `end` for a curve over a logarithm of time: each one, then a tenth later
  // each.
  static std::vector<std::uint32_t> samples(std::uint32_t from, std::uint32_t end);

  // A run whose ledgers do not balance proves nothing. If they must balance and do not, speed() throws
  // std::runtime_error.
  enum class Books { must_balance, are_asked_for };
  Speed speed(Books books = Books::must_balance) const;

 private:
  std::unique_ptr<run::Simulation> simulation_;
  std::vector<std::string> warnings_;
  std::optional<double> baseline_;
};

}  // namespace voxmelt::accuracy
