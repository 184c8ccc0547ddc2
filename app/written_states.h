// `voxmelt run --write` writes states for other programs while it runs.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/drawn_surface.h"
#include "app/run_record.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// Returns the names of formats that --write lists. Throws UsageError for others, and for one that comes
// twice.
std::vector<std::string> formats_named(const std::string& list);
// Throws UsageError if this machine lacks something that a format needs.
void check_format(const std::string& name, const std::string& option);
// Returns "npy: NumPy arrays; vti: ...", for the help of a command.
std::string format_list();

// The formats of fields have a folder for each state, states/step_00010. The format csv is one file, with a
// row for each of them. Where vti is among them, states.pvd lists the images with their times.
class WrittenStates {
 public:
  // Goes on after step `begun_at`, with the rows that are in the folder already.
  WrittenStates(const RunRecord& record, std::filesystem::path folder, std::uint32_t begun_at);

  // Writes the state if it is due. It is called after each step, because it knows the time of a step, too.
  void add(const run::Simulation& simulation, const scene::Scene& scene);
  // Puts all rows and the list into their files. Whoever goes on from here finds them there.
  void settle();
  // Says where the states are, if there are any.
  void print_place(const std::string& place) const;

 private:
  using Clock = std::chrono::steady_clock;

  const RunRecord& record_;
  std::filesystem::path folder_;
  std::string rows_;  // of the table, as far as it is known
  bool settled_ = true;
  Clock::time_point last_ = Clock::now();
  std::uint32_t last_step_;
  std::size_t states_ = 0;
  DrawnSurface surface_;
};

// Takes over what was written up to a step, where the run's record says that it is due.
void take_over_written(const std::filesystem::path& from, const std::filesystem::path& to,
                       const RunRecord& record, std::uint32_t step);

}  // namespace voxmelt::app
