// The pipeline's part of `voxmelt verify` simulates, prints, and writes the results.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "app/interrupt.h"
#include "app/print.h"
#include "app/run_ahead.h"
#include "app/verify_command.h"
#include "app/verify_energy.h"
#include "app/verify_report.h"
#include "app/verify_rtl.h"
#include "app/verify_shrink.h"
#include "app/verify_sizes.h"
#include "app/visibility.h"
#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/explore/predict_run.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/report/report.h"
#include "hwmodel/pipeline/streams/memory_streams.h"

namespace voxmelt::app {

void print_plant(const hwmodel::VerifyReport& report) {
  const auto& at = *report.strike;
  print("planted: {}, step {}, cell ({}, {}, {}); {}\n", at.where, at.step, at.x, at.y, at.z,
        report.mismatch == nullptr     ? "NOT FOUND"
        : report.found_where_planted() ? "found there"
                                       : "found, but ELSEWHERE");
}

namespace {

// Gives the verdict in one line.
std::string quiet_verdict(const hwmodel::VerifyReport& report) {
  if (report.mismatch == nullptr)
    return fmt::format("{} cells compared: no difference; digest {:016x}{}\n", report.compared_cells,
                       report.digest, report.strike ? "; the planted fault was NOT FOUND" : "");
  const hwmodel::Mismatch& m = *report.mismatch;
  if (m.kind == hwmodel::Mismatch::Kind::hang)
    return fmt::format("HANGS: {}, step {}; cell ({}, {}, {}) is waited for{}\n", m.where, m.step, m.x, m.y,
                       m.z,
                       !report.strike                 ? ""
                       : report.found_where_planted() ? "; planted there"
                                                      : "; planted ELSEWHERE");
  return fmt::format("DIFFERS ({}): {}, step {}, cell ({}, {}, {}), {} expected {}, is {}{}\n",
                     name_of(m.kind), m.where, m.step, m.x, m.y, m.z, m.field.empty() ? "value" : m.field,
                     m.expected, m.actual,
                     !report.strike                 ? ""
                     : report.found_where_planted() ? "; planted there"
                                                    : "; planted ELSEWHERE");
}

void print_result(const VerifyCommand& command, const scene::Scene& scene, const Verified& run,
                  const std::string& fast) {
  const hwmodel::VerifyReport& report = run.report;
  const hwmodel::Configuration& c = run.configuration;
  if (command.common.quiet)
    return print("{}: {} cycles, predicted {}\n{}", name_of(scene), report.cycles, report.predicted_cycles,
                 quiet_verdict(report));
  print("{}: lanes {}, cascade {}, fifo depth {}, stall seed {}; steps {} to {}\n", name_of(scene), c.lanes,
        c.cascade, c.fifo_depth, c.stall_seed, report.first_step, report.first_step + report.steps);
  print("{}", hwmodel::table_of(report, run.design, c));
  if (run.dram && report.mismatch == nullptr)
    print("{}", hwmodel::memory_text(run.dram->counts, run.dram->parameters));
  if (run.cost) print("{}", text_of(*run.cost, run.clock_mhz));
  const auto stages = std::count_if(
      report.stages.begin(), report.stages.end(),
      [](const hwmodel::StageReport& stage) { return is_stage(stage.kind) && stage.cascade == 0; });
  if (report.mismatch == nullptr)
    print(
        "{} cells compared behind {} stages of a time step, {} of the software ({}): no difference; digest "
        "{:016x}\n",
        report.compared_cells, stages, report.software_cells,
        fast == "reference" ? "the reference itself" : fast, report.digest);
  else
    print("{}", hwmodel::text_of(*report.mismatch));
  if (report.strike) print_plant(report);
}

// Holds what is verified, and the command that says where results go.
struct Job {
  const VerifyCommand& command;
  hwmodel::Preset preset;
  scene::Scene scene;
  hwmodel::Fault fault = hwmodel::Fault::none;
};

Job job_of(VerifyCommand& command) {
  const hwmodel::FaultInfo* fault = hwmodel::find_fault(command.plant);
  if (!command.plant.empty() && fault == nullptr)
    throw UsageError(
        fmt::format("error: --plant {}: unknown; `voxmelt list faults` names them", command.plant));
  hwmodel::Preset preset = hwmodel::load_preset(find_preset(command.hw), command.hw_sets);
  Job job{command, std::move(preset), load_beginning(command),
          fault == nullptr ? hwmodel::Fault::none : fault->fault};
  if (!command.rtl.empty()) job.preset.configuration.registers = true;
  check_pipeline(job.scene, job.preset.configuration);
  if (!command.size_fifos.empty() && job.preset.caster.dram && job.preset.configuration.coded &&
      job.scene.parameters.flow.law == rule::Law::viscous && job.scene.parameters.flow.viscous.substeps != 1)
    throw UsageError(
        "error: --size-fifos: not with hw.coded on hw.memory for a scene with sub-steps; what the memory "
        "moves would depend on the state between them");
  return job;
}

void check_places(const Job& job) {
  const VerifyCommand& command = job.command;
  check_replay_place(command, job.scene);
  const std::string replay = replay_place(command, job.scene).string();
  check_report_place(command.common, replay);
  check_html_place(command.common, command.picture, replay);
  check_place("--vcd", command.vcd, replay);
  check_place("--shrink", command.shrink, replay);
  check_place("--size-fifos", command.size_fifos, replay);
  keep_inputs(job.scene, {{"--html", command.picture.html},
                          {"--vcd", command.vcd},
                          {"--shrink", command.shrink},
                          {"--size-fifos", command.size_fifos}});
}

hwmodel::VerifyOptions options_of(const Job& job, std::uint32_t first_step, hwmodel::StreamMemory* memory) {
  const VerifyCommand& command = job.command;
  hwmodel::VerifyOptions options;
  options.memory = memory;
  options.steps = command.steps;
  options.every = command.every;
  options.configuration = job.preset.configuration;
  options.fault = job.fault;
  options.fault_step = plant_step(command, first_step);
  options.poll = stop_if_interrupted;
  options.waves = !command.vcd.empty();
  options.waves_from = command.vcd_from;
  options.timeline = !command.common.report.empty() || !command.picture.html.empty();
  return options;
}

// A run that ended early has no cost: some numbers would be those of half a pass.
void add_cost(Verified& run) {
  if (run.report.mismatch != nullptr) return;
  std::optional<hwmodel::memory::Energy> dram;
  if (run.dram && !run.dram->parameters.rails.empty())
    dram = hwmodel::memory::energy_of(run.dram->counts, run.dram->parameters);
  run.cost = cost_of(run.report, run.design, run.clock_mhz, dram);
}

void write_reports(const Job& job, const Verified& run) {
  write_pipeline_report({job.command.common, job.command.picture.html}, name_of(job.scene), run);
}

// Writes what shows a difference again: the replay, and with --shrink a small case.
void write_difference(const Job& job, hwmodel::VerifyOptions options, const hwmodel::VerifyReport& report) {
  try_writing([&] { write_replay(job.command, job.scene, report); });
  if (job.command.shrink.empty()) return;
  options.memory = nullptr;  // the small case has other streams
  try_writing([&] {
    const std::string small = make_small(job.command, job.scene, options, report);
    if (!job.command.common.quiet) print("{}", small);
  });
}

}  // namespace

int verify_pipeline(VerifyCommand command) {
  Job job = job_of(command);
  check_places(job);
  end_soon_at_interrupts();
  run::Simulation ahead = run_ahead(job.scene, command.common, command.from, command.steps);

  const VerifiedStream stream{job.scene.parameters, ahead.volume(), ahead.step_number(), command.steps};
  check_channels(stream, job.preset);
  std::optional<std::int64_t> sized_cycles;
  if (!command.size_fifos.empty())
    sized_cycles = size_channels(stream, command.common, command.size_fifos, job.preset);

  const hwmodel::Configuration& c = job.preset.configuration;
  const hwmodel::Design design = hwmodel::design_of(job.scene.parameters, ahead.volume().grid, c);
  const hwmodel::memory::Choice memory = job.preset.caster.memory();
  std::optional<hwmodel::MemoryStreams> dram;
  std::optional<hwmodel::memory::TraceFiles> traces;
  if (memory.dram) {
    dram.emplace(design, c.cascade, *memory.dram, memory.clock_mhz);
    dram->log(traces.emplace(memory.trace, memory.command_trace));
  }
  hwmodel::VerifyOptions options = options_of(job, ahead.step_number(), dram ? &*dram : nullptr);
  RtlChoice rtl(command, job.scene.parameters, ahead.volume().grid, options);
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  const step::Implementation& fast = find_phased_implementation(command.common);
  hwmodel::VerifyReport report =
      hwmodel::verify(job.scene.parameters, ahead.volume(), ahead.step_number(), fast, tuning, options);
  Verified verified{report, design, c, memory.clock_mhz};
  if (memory.dram) {
    verified.dram = {*memory.dram, dram->all_counts()};
    const state::Volume start = ahead.volume();
    ahead.begin_step();  // computes the irradiance of the step
    hwmodel::explore::predict_on_memory(report, design, c, memory, start, ahead.irradiance());
  }

  add_cost(verified);
  const hwmodel::Verdict verdict = hwmodel::verdict_of(report, job.fault != hwmodel::Fault::none);
  if (verdict == hwmodel::Verdict::never_struck)
    throw UsageError(fmt::format(
        "error: --plant {}: in these steps of this scene there is nothing that this fault could change",
        command.plant));
  print_result(command, job.scene, verified, fast.name);
  const bool alike = rtl.agrees_with_models(stream, fast, tuning, options, report, command.common.quiet);
  if (verdict == hwmodel::Verdict::good) {
    write_reports(job, verified);
    const std::string no_waves = write_waves(command.vcd, command.vcd_from, report.waves);
    if (!no_waves.empty()) throw UsageError(no_waves);
    if (!command.shrink.empty() && !command.common.quiet)
      print("--shrink: there is no difference to make small\n");
    return alike && (!sized_cycles || check_sized(*sized_cycles, report.cycles)) ? kDone : kCheckFailed;
  }
  try_writing([&] { write_reports(job, verified); });
  try_writing([&] {
    const std::string no_waves = write_waves(command.vcd, command.vcd_from, report.waves);
    if (!no_waves.empty()) say(no_waves);
  });
  if (report.mismatch != nullptr) write_difference(job, options, report);
  return kCheckFailed;
}

}  // namespace voxmelt::app
