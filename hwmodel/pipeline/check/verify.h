// In lock-step the hardware model runs beside the reference and a software kernel, and is compared after
// every stage.
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
  std::uint32_t fault_step = 0;  // first step in which the fault may strike
  std::function<void()> poll;    // called now and then; what it throws ends everything
  // Unless it is 0, `visit` is called after every so many steps. It gets the model's memory and what the run
  // took so far: passes, cycles, stages. No pass reaches beyond. If `visit` returns false, the run ends.
  std::uint32_t visit_every = 0;
  std::function<bool(const state::Volume&, const VerifyReport&)> visit;
  // If set, the waves keep the cycles around the first difference or, if it is given, from `waves_from` on.
  bool waves = false;
  std::optional<std::int64_t> waves_from;
  bool timeline = false;  // note what every stage did when
  // Makes the machine to be verified. If it is empty, the SystemC pipeline of `configuration` is verified. A
  // machine made here has that configuration, too.
  std::function<std::unique_ptr<StreamMachine>()> machine;
  StageMaker make;  // makes the pipeline's stages; empty: those of `fault`
  // The pipeline waits for this memory. The closed form of its cycles does not hold with it.
  StreamMemory* memory = nullptr;
  // Other machines may run in this simulation, too. If it is null, the pipeline has one of its own.
  Simulation* simulation = nullptr;
  // This is called after every train, with its passes and what was fed.
  std::function<void(const std::vector<Pass>& passes, const Fed& fed)> streamed;
};

// Describes passes that followed one another without a gap.
struct TrainReport {
  std::uint32_t step = 0;  // first step
  std::int64_t passes = 0, cycles = 0, predicted = 0;
  // Holds the cycles by the closed form of a DRAM, if a caller has computed them.
  std::optional<std::int64_t> predicted_on_memory{};
};

struct VerifyReport {
  std::uint32_t first_step = 0, steps = 0;  // steps done without a mismatch
  std::int64_t compared_cells = 0;          // cells behind stages of the model, compared with the reference
  std::int64_t software_cells = 0;          // cells of the software kernel, compared with the reference
  std::int64_t passes = 0, cycles = 0, predicted_cycles = 0;
  double model_seconds = 0;  // time of the model's simulation alone, comparing included
  std::int64_t cell_steps = 0;
  std::unique_ptr<Mismatch> mismatch;
  std::optional<FaultPlan::Strike> strike;  // place of the planted fault
  std::vector<StageReport> stages;
  std::vector<ChannelReport> channels;
  std::optional<IrradianceStream::Counts> irradiance;  // lies in memory at the end; none without radiation
  std::vector<TrainReport> trains;                     // trains that ended well
  std::vector<int> substeps;                           // of each step, where the state decides on them
  std::optional<double> most_bytes_per_cycle{};        // rate of the DRAM, if a caller has given it
  std::string waves;                                   // VCD; empty: there are none
  Timeline timeline;                                   // empty, unless it was asked for
  std::uint64_t digest = 0;                            // digest of the model's last state
  // The mismatch can be replayed from this state, and this is its step number. It is a step of visibility, or
  // the first step.
  std::optional<state::Volume> replay;
  std::uint32_t replay_step = 0;
  std::uint32_t pass_end = 0;  // the step after the last one of the last pass

  // Sums over all trains, if each has a prediction.
  std::optional<std::int64_t> predicted_on_memory() const;

  // Returns true if the checker found the planted fault where it was planted.
  bool found_where_planted() const;
};

// The verdict of a run follows these rules. Any difference counts, whether it was planted or not. A fault
// that changed nothing proves nothing. A fault that struck and was not found shows that the checker is blind.
enum class Verdict { good, failed, never_struck };
inline Verdict verdict_of(const VerifyReport& report, bool planted) {
  if (report.mismatch != nullptr) return Verdict::failed;
  if (!planted) return Verdict::good;
  return report.strike ? Verdict::failed : Verdict::never_struck;
}

// Does the same as `verify` in two parts. The constructor makes the pipeline, as long as its simulation has
// not run yet. All that is given must live as long as this object.
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
