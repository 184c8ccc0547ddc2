#include "hwmodel/machine/machine.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hwmodel/fabric/simulation.h"
#include "hwmodel/machine/screen.h"
#include "hwmodel/memory/chosen_memory.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"

namespace voxmelt::hwmodel {
namespace {

// Sums up the work of the pipeline so far. Its cycles are those on a memory that always answers.
StreamWork work_of(const VerifyReport& report) {
  StreamWork work;
  work.passes = report.passes;
  work.cycles = report.predicted_cycles;
  for (const StageReport& stage : report.stages) {
    if (stage.kind == StageKind::reader) {
      work.tokens += stage.cycles.busy;
      work.read_bits += stage.moved_bits;
    }
    if (stage.kind == StageKind::writer) work.written_bits += stage.moved_bits;
    if (is_feed(stage.kind)) work.fed_bits += stage.moved_bits;
  }
  return work;
}

memory::Choice untraced(memory::Choice choice) {
  choice.trace.clear();
  return choice;
}

// Repeats the trains of the machine with the pipeline alone on a memory. Its cycles tell what the ray caster
// beside the pipeline costs. Nobody checks its results.
class StreamAlone {
 public:
  StreamAlone(const MachineInput& input, const MachineOptions& options)
      : memory_(untraced(options.picture.configuration.memory())),
        pipeline_(input.parameters, input.picture.volume.grid, options.steps.configuration, make_stage,
                  &simulation_),
        streams_(pipeline_.design(), options.steps.configuration.cascade, memory_.memory(), 0),
        volume_(input.picture.volume) {
    simulation_.after_blocks([this] { memory_.memory().cycle(); });
    pipeline_.memory(&streams_);
    pipeline_.poll(options.steps.poll);
  }

  void run(const std::vector<Pass>& passes, const Fed& fed) {
    std::size_t begun = 1;
    const auto next = [&] { return begun < passes.size() ? std::optional(passes[begun++]) : std::nullopt; };
    cycles_ += pipeline_.run_train(passes.front(), next, fed, volume_).cycles;
  }
  std::int64_t cycles() const { return cycles_; }  // sum over all trains

 private:
  Simulation simulation_;
  memory::ChosenMemory memory_;
  Pipeline pipeline_;
  MemoryStreams streams_;
  state::Volume volume_;
  std::int64_t cycles_ = 0;
};

class Run {
 public:
  Run(const MachineInput& input, const MachineOptions& options)
      : input_(input),
        options_(options),
        design_(design_of(input.parameters, input.picture.volume.grid, options.steps.configuration)),
        screen_(input.picture, options.picture),
        memory_(options.picture.configuration.memory()),
        streams_(design_, options.steps.configuration.cascade, memory_.memory(), 0),
        alone_(input, options),
        lockstep_(input.parameters, input.picture.volume, input.first_step, input.fast, input.tuning,
                  steps_) {
    // The state lies at the beginning of the memory. The ray caster's data lie behind it.
    const std::int64_t align = memory_.memory().alignment(),
                       bytes = stream_bytes(design_, options.steps.configuration.coded);
    screen_.connect({simulation_, memory_.memory(), (bytes + align - 1) / align * align});
    simulation_.after_blocks([this] { memory_.memory().cycle(); });
  }

  MachineReport run() {
    report_.first_upload = screen_.upload();
    screen_.draw_alone();
    report_.first_frame = screen_.alone().last().cycles;
    // With a planted fault this picture is left out, so that the fault may strike while both machines work.
    if (options_.picture.fault == raycast::Fault::none) {
      screen_.begin();
      screen_.finish();  // from now on the caches are warm
    }
    if (screen_.good()) {
      begin_period();
      report_.steps = lockstep_.run();
      screen_.finish();  // completes the last picture, also after a difference
    }
    report_.pictures = screen_.report();
    report_.pictures.memory.dram = memory_.dram_counts();  // traffic of both machines
    report_.pictures.memory.bus_cycles = memory_.bus_cycles();
    const Shape& shape = design_.shape;
    report_.cells = shape.grid.cells();
    const std::int64_t words = std::int64_t{shape.grid_blocks()} * shape.lanes * shape.grid.y * shape.grid.z;
    const int copies = shape.tiled() ? 2 : 1;  // tiles overlap, see state_memory.h
    const CodeLayout layout(design_);
    const std::int64_t bits = options_.steps.configuration.coded ? layout.slot_bits() * layout.columns()
                                                                 : words * design_.cell_bits();
    report_.state_bytes = (copies * bits + 7) / 8;
    report_.irradiance_bytes = design_.hot() && input_.parameters.heat.radiation ? 2 * words : 0;
    return std::move(report_);
  }

 private:
  // Returns options by which the pipeline is part of the simulation and works on the memory.
  VerifyOptions steps() {
    VerifyOptions steps = options_.steps;
    steps.simulation = &simulation_;
    steps.memory = &streams_;
    steps.visit_every = steps.steps / options_.picture.frames;
    steps.visit = [this](const state::Volume& volume, const VerifyReport& done) {
      return visit(volume, done);
    };
    steps.streamed = [this](const std::vector<Pass>& passes, const Fed& fed) { alone_.run(passes, fed); };
    return steps;
  }

  // The pipeline computes the next steps while the ray caster draws the present state.
  void begin_period() {
    began_ = simulation_.cycle();
    screen_.begin();
  }

  bool visit(const state::Volume& volume, const VerifyReport& done) {
    Period period;
    period.step = done.first_step + done.steps;
    period.stream_beside = done.cycles - before_cycles_;
    before_cycles_ = done.cycles;
    screen_.finish();
    if (!screen_.good()) return false;
    period.frame_beside = screen_.beside().last().cycles;
    period.together = simulation_.cycle() - began_;

    const StreamWork all = work_of(done);
    period.work = all - before_;
    before_ = all;
    period.stream = alone_.cycles() - before_alone_;
    before_alone_ = alone_.cycles();
    period.upload = screen_.take_over(volume);
    period.host_seconds = screen_.host_seconds();
    const raycast::MemoryCounts counts = screen_.alone().memory_counts();
    screen_.draw_alone();
    const raycast::MemoryCounts now = screen_.alone().memory_counts();
    period.frame = screen_.alone().last().cycles;
    period.frame_read = now.read_bytes - counts.read_bytes;
    period.frame_written = now.written_bytes - counts.written_bytes;
    period.frame_bus = now.bus_cycles - counts.bus_cycles;
    report_.periods.push_back(std::move(period));
    if (screen_.good()) begin_period();
    return screen_.good();
  }

  const MachineInput& input_;
  const MachineOptions& options_;
  Design design_;
  Simulation simulation_;  // shared by both machines
  Screen screen_;
  memory::ChosenMemory memory_;
  MemoryStreams streams_;
  StreamAlone alone_;
  VerifyOptions steps_ = steps();
  Lockstep lockstep_;
  StreamWork before_;
  std::int64_t began_ = 0, before_cycles_ = 0, before_alone_ = 0;
  MachineReport report_;
};

}  // namespace

Period MachineReport::sum() const {
  Period sum;
  for (const Period& period : periods) {
    sum.step = period.step;
    sum.work.passes += period.work.passes;
    sum.work.cycles += period.work.cycles;
    sum.work.tokens += period.work.tokens;
    sum.work.read_bits += period.work.read_bits;
    sum.work.fed_bits += period.work.fed_bits;
    sum.work.written_bits += period.work.written_bits;
    sum.stream += period.stream;
    sum.frame += period.frame;
    sum.upload.words += period.upload.words;
    sum.upload.bursts += period.upload.bursts;
    sum.upload.cycles += period.upload.cycles;
    for (std::size_t i = 0; i < raycast::kSentVolumes; ++i) sum.upload.bytes[i] += period.upload.bytes[i];
    sum.frame_read += period.frame_read;
    sum.frame_written += period.frame_written;
    sum.frame_bus += period.frame_bus;
    sum.together += period.together;
    sum.stream_beside += period.stream_beside;
    sum.frame_beside += period.frame_beside;
    sum.host_seconds += period.host_seconds;
  }
  return sum;
}

MachineReport verify_machine(const MachineInput& input, const MachineOptions& options) {
  return Run(input, options).run();
}

}  // namespace voxmelt::hwmodel
