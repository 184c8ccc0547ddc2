#include "hwmodel/machine/machine.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hwmodel/machine/screen.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::hwmodel {
namespace {

// What the pipeline did so far.
StreamWork work_of(const VerifyReport& report, const Design& design, const Configuration& c) {
  StreamWork work;
  work.passes = report.passes;
  work.cycles = report.cycles;
  const std::int64_t interval = c.fifo_depth == 1 ? 2 : 1;
  const Shape& shape = design.shape;
  work.lag = std::max<std::int64_t>(report.predicted_cycles / std::max<std::int64_t>(report.passes, 1) -
                                        interval * shape.tiles() * shape.tokens(),
                                    0);
  for (const StageReport& stage : report.stages) {
    if (stage.kind == StageKind::reader) work.tokens += stage.cycles.busy, work.read_bits += stage.moved_bits;
    if (stage.kind == StageKind::writer) work.written_bits += stage.moved_bits;
    if (stage.kind == StageKind::feed) work.fed_bits += stage.moved_bits;
  }
  return work;
}

class Run {
 public:
  Run(const MachineInput& input, const MachineOptions& options)
      : input_(input),
        options_(options),
        design_(design_of(input.parameters, input.picture.volume.grid, options.steps.configuration)),
        screen_(input.picture, options.picture) {}

  MachineReport run() {
    report_.first_upload = screen_.take_over(input_.picture.volume);
    screen_.draw();
    report_.first_frame = screen_.alone().last().cycles;
    VerifyOptions steps = options_.steps;
    steps.visit_every = steps.steps / static_cast<std::uint32_t>(options_.picture.frames);
    steps.visit = [this](const state::Volume& volume, const VerifyReport& done) {
      return visit(volume, done);
    };
    if (screen_.good())
      report_.steps = verify(input_.parameters, input_.picture.volume, input_.first_step, input_.fast,
                             input_.tuning, steps);
    report_.pictures = screen_.report();
    report_.different_beside = screen_.different_beside();
    const Shape& shape = design_.shape;
    report_.cells = shape.grid.cells();
    const std::int64_t words = std::int64_t{shape.grid_blocks()} * shape.lanes * shape.grid.y * shape.grid.z;
    const int copies = shape.tiled() ? 2 : 1;  // tiles overlap: state_memory.h
    const CodeLayout layout(design_);
    const std::int64_t bits = options_.steps.configuration.coded ? layout.slot_bits() * layout.columns()
                                                                 : words * design_.cell_bits();
    report_.state_bytes = (copies * bits + 7) / 8;
    report_.irradiance_bytes = design_.hot() && input_.parameters.heat.radiation ? 2 * words : 0;
    return std::move(report_);
  }

 private:
  bool visit(const state::Volume& volume, const VerifyReport& done) {
    Period of;
    of.step = done.first_step + done.steps;
    const StreamWork all = work_of(done, design_, options_.steps.configuration);
    of.work = all - before_;
    before_ = all;
    of.stream = cycles_alone(of.work, options_.picture.configuration);
    screen_.draw_beside(of.work);
    of.frame_beside = screen_.beside().last().cycles;
    of.stream_beside = screen_.twin().cycles();
    of.together = std::max(of.frame_beside, of.stream_beside);

    of.upload = screen_.take_over(volume);
    of.host_seconds = screen_.host_seconds();
    const raycast::MemoryCounts counts = screen_.alone().memory_counts();
    screen_.draw();
    const raycast::MemoryCounts now = screen_.alone().memory_counts();
    of.frame = screen_.alone().last().cycles;
    of.frame_read = now.read_bytes - counts.read_bytes;
    of.frame_written = now.written_bytes - counts.written_bytes;
    of.frame_bus = now.bus_cycles - counts.bus_cycles;
    report_.periods.push_back(std::move(of));
    return screen_.good();
  }

  const MachineInput& input_;
  const MachineOptions& options_;
  Design design_;
  Screen screen_;
  StreamWork before_;
  MachineReport report_;
};

}  // namespace

Period MachineReport::sum() const {
  Period sum;
  for (const Period& of : periods) {
    sum.step = of.step;
    sum.work.passes += of.work.passes, sum.work.cycles += of.work.cycles, sum.work.tokens += of.work.tokens;
    sum.work.read_bits += of.work.read_bits, sum.work.fed_bits += of.work.fed_bits;
    sum.work.written_bits += of.work.written_bits;
    sum.stream += of.stream, sum.frame += of.frame;
    sum.upload.words += of.upload.words, sum.upload.bursts += of.upload.bursts;
    sum.upload.cycles += of.upload.cycles;
    for (std::size_t i = 0; i < raycast::kSentVolumes; ++i) sum.upload.bytes[i] += of.upload.bytes[i];
    sum.frame_read += of.frame_read, sum.frame_written += of.frame_written, sum.frame_bus += of.frame_bus;
    sum.together += of.together;
    sum.stream_beside += of.stream_beside, sum.frame_beside += of.frame_beside;
    sum.host_seconds += of.host_seconds;
  }
  return sum;
}

MachineReport verify_machine(const MachineInput& input, const MachineOptions& options) {
  return Run(input, options).run();
}

}  // namespace voxmelt::hwmodel
