// Lock-step: the hardware model beside the reference and a software kernel, compared after every stage.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/pipeline/check/mismatch.h"
#include "hwmodel/pipeline/check/timeline.h"
#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/stream_machine.h"
#include "kernel/automaton/step/stepper.h"

namespace voxmelt::hwmodel {

class Simulation;
struct VerifyReport;
struct VerifyOptions {
  std::uint32_t steps = 10;
  std::uint32_t every = 1;  // compare every K-th step, and the last
  Configuration configuration;
  Fault fault = Fault::none;
  std::uint32_t fault_step = 0;  // the first step in which it may strike
  std::function<void()> poll;    // called now and then; what it throws ends everything
  // Unless it is 0, `visit` is called after every so many steps, with the model's memory and with what it all
  // took so far: passes, cycles, stages. No pass reaches beyond. If it gives false, the run ends.
  std::uint32_t visit_every = 0;
  std::function<bool(const state::Volume&, const VerifyReport&)> visit;
  bool waves =
      false;  // keep the cycles around the first difference or, if that is given, from `waves_from` on
  std::optional<std::int64_t> waves_from;
  bool timeline = false;  // note what every stage did when
  // What is verified; empty: the SystemC pipeline of `configuration`. Its own has that configuration, too.
  std::function<std::unique_ptr<StreamMachine>()> machine;
  StageMaker make;                 // of the pipeline's stages; empty: those of `fault`
  StreamMemory* memory = nullptr;  // that the pipeline waits for; the closed form of its cycles does not hold
  Simulation* simulation = nullptr;  // in which other machines may run, too; null: one of its own
  // Called after every train, with its passes.
  std::function<void(const std::vector<Pass>& passes, const IrradianceStream* irradiance)> streamed;
};

// Passes that followed one another without a gap.
struct TrainReport {
  std::uint32_t step = 0;  // its first one
  std::int64_t passes = 0, cycles = 0, predicted = 0;
  std::optional<std::int64_t> predicted_on_memory{};  // by the closed form of a DRAM, if someone has asked it
};

struct VerifyReport {
  std::uint32_t first_step = 0, steps = 0;  // done without a mismatch
  std::int64_t compared_cells = 0;          // behind stages of the model, with the reference
  std::int64_t software_cells = 0;          // of the software kernel, with the reference
  std::int64_t passes = 0, cycles = 0, predicted_cycles = 0;
  double model_seconds = 0;  // of the model's simulation alone, comparing included
  std::int64_t cell_steps = 0;
  std::unique_ptr<Mismatch> mismatch;
  std::optional<FaultPlan::Strike> strike;  // of the planted fault
  std::vector<StageReport> stages;
  std::vector<ChannelReport> channels;
  std::optional<IrradianceStream::Counts>
      irradiance;                                // that lies in memory at the end; none without radiation
  std::vector<TrainReport> trains;               // those that ended well
  std::optional<double> most_bytes_per_cycle{};  // of the DRAM, if someone has said it
  std::string waves;                             // VCD; empty: there are none
  Timeline timeline;                             // empty, unless it was asked for
  std::uint64_t digest = 0;                      // of the model's last state
  // The state from which the mismatch can be replayed, and its step number: a step of visibility, or
  // the first.
  std::optional<state::Volume> replay;
  std::uint32_t replay_step = 0;
  std::uint32_t pass_end = 0;  // the step after the last one of the last pass

  // Of all trains, where each has one.
  std::optional<std::int64_t> predicted_on_memory() const;

  // Did the checker find the planted fault, and where it was planted?
  bool found_where_planted() const;
};

// The verdict of a run. Any difference counts, whether it was planted or not. A fault that changed nothing
// proves nothing. A fault that struck and was not found shows that the checker is blind.
enum class Verdict { good, failed, never_struck };
inline Verdict verdict_of(const VerifyReport& report, bool planted) {
  if (report.mismatch != nullptr) return Verdict::failed;
  if (!planted) return Verdict::good;
  return report.strike ? Verdict::failed : Verdict::never_struck;
}

// The same in two parts: the constructor makes the pipeline, as long as its simulation has not run yet. All
// that is given must live as long.
class Lockstep {
 public:
  Lockstep(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
           const step::Implementation& fast, const step::Tuning& tuning, const VerifyOptions& options);
  Lockstep(const Lockstep&) = delete;
  Lockstep& operator=(const Lockstep&) = delete;
  ~Lockstep();
  VerifyReport run();

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

// Verifies from `start`, the state before step number `first_step`. With radiation that must be a step of
// visibility. Throws std::logic_error if nothing was compared.
VerifyReport verify(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
                    const step::Implementation& fast, const step::Tuning& tuning,
                    const VerifyOptions& options);

}  // namespace voxmelt::hwmodel
