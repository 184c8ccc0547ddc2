// The expectation is what the pipeline has to give behind each of its stages. It comes from the reference, as
// the state after every phase. Inside a phase, the state after each stage comes from running the reference
// with the later parts of the phase switched off.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/pipeline/check/mismatch.h"
#include "hwmodel/pipeline/check/side_bands.h"
#include "hwmodel/pipeline/check/snapshots.h"
#include "hwmodel/pipeline/model/stage_kind.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/run/simulation.h"

namespace voxmelt::hwmodel {

struct Expected {
  std::shared_ptr<const state::Volume> before, after;  // before and after the stage
  SideBands bands;
};

class Expectation {
 public:
  // `fast` is the software kernel that is compared with the reference on the way. `stages` are those of a
  // time step, with settle and spread once.
  Expectation(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
              const step::Implementation& fast, const step::Tuning& tuning, std::vector<StageKind> stages);

  // Runs one step. With `keep` it also returns what is expected behind every stage, in the order of the
  // stages of one time step, settle and spread once for each sub-step. A difference between the two software
  // kernels, or a phase without a stage that changes something, is returned as a mismatch.
  struct Step {
    std::vector<Expected> stages;
    std::unique_ptr<Mismatch> mismatch;
  };
  Step step(bool keep);

  const state::Volume& volume() const { return reference_.volume(); }
  const step::Irradiance* irradiance() const { return reference_.irradiance(); }
  std::uint32_t step_number() const { return reference_.step_number(); }
  // Returns the cells that fall in the step that has begun, if any does.
  std::optional<state::BitPlane> falling() const;
  int substeps() const { return reference_.substeps(); }  // sub-steps of the latest step that has begun
  // Counts the cells in which `fast` was compared with the reference.
  std::int64_t compared_cells() const { return compared_cells_; }

  // Prepares the next step (its visibility) without running it.
  void begin_step();

 private:
  using Snapshot = std::shared_ptr<const state::Volume>;

  std::unique_ptr<Mismatch> compare_software(step::Phase phase) const;
  // Reports a tile of `fast` that sleeps beside what the flow has changed in the step that ends.
  std::unique_ptr<Mismatch> compare_sleep(const state::Volume& before_flow, step::Phase last) const;
  // Appends the stages of one phase, given its moment, and the state before and after it.
  void expect_inside(step::Phase phase, step::Moment moment, const Snapshot& before, const Snapshot& after,
                     std::vector<Expected>& stages);
  SideBands bands_behind(StageKind stage, step::Moment moment, const state::Volume& before);
  Snapshot heat_up_to(StageKind stage, const state::Volume& before);
  std::shared_ptr<const state::BitPlane> set_cells(const state::Volume& before);
  std::shared_ptr<const state::Field<std::uint8_t>> patterns(const state::Volume& before);
  std::shared_ptr<const ShownRuns> runs(step::Moment moment, const state::Volume& before);
  bool falls_by_sides() const;  // do the four sides of a cell matter to its fall?

  rule::Parameters parameters_;
  run::Simulation reference_, fast_;
  std::string fast_name_;
  std::vector<StageKind> stages_;
  Snapshots snapshots_;
  // The following belong to the present step. `around_` looks around the cells before the phase `heat` or,
  // under the viscous law, before the spread. `shown_` has the runs of the present sub-step. `melted_` has
  // run the phase melt, and knows what is set.
  std::shared_ptr<const Surroundings> around_;
  std::shared_ptr<const ShownRuns> shown_;
  std::shared_ptr<const state::Volume> unfallen_;  // with pieces: the state before they fall
  std::unique_ptr<scalar::Reference> melted_;
  std::shared_ptr<const state::BitPlane> set_;
  bool begun_ = false;
  std::int64_t compared_cells_ = 0;
};

}  // namespace voxmelt::hwmodel
