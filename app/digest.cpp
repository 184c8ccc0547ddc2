// The command `voxmelt digest` prints one line per K steps. Equal lines mean equal bits.
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/report.h"
#include "app/run_journal.h"
#include "app/visibility.h"
#include "app/watch.h"
#include "kernel/automaton/state/digest.h"

namespace voxmelt::app {
namespace {

struct DigestOptions {
  Common common;
  std::string journal;
  std::uint32_t steps = 10, every = 0;
};

void print_line(const run::Simulation& simulation) {
  const state::Volume& volume = simulation.volume();
  const state::Holdings held = state::holdings(volume);
  print("step {} digest {:016x} mass {} solid {} liquid {}\n", simulation.steps_done(), state::digest(volume),
        state::to_string(held.solid + held.liquid), volume.solid.count(), volume.liquid.count());
  if (std::fflush(stdout) != 0) throw OutputStopped{errno};
}

int run_digest(const DigestOptions& options) {
  scene::Scene scene = load_scene(options.common);
  keep_inputs(scene, {{"--report", options.common.report}});
  check_report_place(options.common, "");
  check_steps(scene, options.steps);
  const std::string journal_lines = journal_text(options.journal);
  run::Simulation simulation = make_simulation(scene, options.common);
  RunJournal journal(journal_lines, options.journal, scene, simulation);
  if (options.every > 0) print_line(simulation);
  while (simulation.steps_done() < options.steps) {
    journal.apply();
    simulation.step();
    const std::uint32_t done = simulation.steps_done();
    if (done == options.steps || (options.every > 0 && done % options.every == 0)) print_line(simulation);
  }
  if (options.steps == 0 && options.every == 0) print_line(simulation);
  Watch watch;
  watch.look(simulation.volume(), simulation.steps_done());
  warn(scene, options.common, watch.warnings(simulation));
  warn_of_limit(scene, options.common, simulation);
  write_report(options.common, report_json(scene, options.common, simulation, {}));
  const std::string drift = drift_text(simulation.drift());
  if (drift.empty()) return kDone;
  say("error: the ledgers do not balance: " + drift);
  return kCheckFailed;
}

}  // namespace

void add_digest(CommandLine& program) {
  auto options = std::make_shared<DigestOptions>();
  const Command command = program.add("digest", "Print the digest of the state: equal lines mean equal bits");
  add_scene(command, options->common);
  command.option("--steps", options->steps, "steps to run").shows_default();
  command.option("--every", options->every, "also a line at step 0 and after every K steps");
  add_journal(command, options->journal);
  add_common(command, options->common);
  add_visibility(command, options->common);
  command.runs([options] { return run_digest(*options); });
}

}  // namespace voxmelt::app
