// The command `voxmelt verify --sleep` runs the software alone. It steps the tiles that sleep, too, and
// compares after every phase.
#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/interrupt.h"
#include "app/print.h"
#include "app/run_ahead.h"
#include "app/verify_command.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/sleep_audit.h"

namespace voxmelt::app {
namespace {

using Json = nlohmann::ordered_json;

struct Audited {
  std::string scene, implementation;
  std::uint32_t first_step = 0, steps = 0;  // steps without a fault
  std::int64_t tiles = 0, asleep = 0;
  std::uint64_t digest = 0;
  std::optional<run::SleepFault> fault;

  std::string_view phase() const { return step::kPhaseNames[step::index_of(fault->phase)]; }
};

Json json_of(const Audited& a) {
  Json json{{"scene", a.scene},   {"implementation", a.implementation},
            {"good", !a.fault},   {"first_step", a.first_step},
            {"steps", a.steps},   {"tile_steps", a.tiles},
            {"asleep", a.asleep}, {"digest", fmt::format("{:016x}", a.digest)}};
  if (a.fault)
    json["difference"] = {{"step", a.fault->step},
                          {"phase", a.phase()},
                          {"cell", {a.fault->x, a.fault->y, a.fault->z}},
                          {"text", a.fault->text()}};
  return json;
}

void print_audit(const Audited& a, bool quiet) {
  if (!quiet)
    print("{}: {}, steps {} to {}; {:.1f} % of the tiles slept, and were stepped, too\n", a.scene,
          a.implementation, a.first_step, a.first_step + a.steps,
          100.0 * static_cast<double>(a.asleep) / static_cast<double>(a.tiles));
  if (a.fault)
    print("first difference (sleep): step {}, phase {}: {}\n", a.fault->step, a.phase(), a.fault->text());
  else
    print("compared after every phase: no difference; digest {:016x}\n", a.digest);
}

}  // namespace

int verify_sleep(VerifyCommand command) {
  scene::Scene scene = load_beginning(command);
  check_report_place(command.common, "");
  keep_inputs(scene, {{"--report", command.common.report}});
  end_soon_at_interrupts();
  const run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);
  const step::Implementation& implementation = find_phased_implementation(command.common);
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  run::SleepAudit audit(scene.parameters, ahead.volume(), ahead.step_number(), implementation, tuning);
  Audited audited{.scene = name_of(scene),
                  .implementation = implementation.name,
                  .first_step = ahead.step_number(),
                  .fault = {}};
  while (audited.steps < command.steps && !(audited.fault = audit.step())) {
    ++audited.steps;
    stop_if_interrupted();
  }
  audited.tiles = audit.tiles();
  audited.asleep = audit.asleep();
  audited.digest = state::digest(audit.volume());
  if (!audited.fault && audited.asleep == 0)
    throw UsageError("error: --sleep: in these steps no tile slept, so there was nothing to compare");
  print_audit(audited, command.common.quiet);
  write_report(command.common, json_of(audited).dump(2) + '\n');
  return audited.fault ? kCheckFailed : kDone;
}

}  // namespace voxmelt::app
