// The program voxmelt melts solid voxel models and lets them flow. It runs and draws; programs beside it
// verify and measure.
#include <string>

#include "app/commands.h"
#include "app/list.h"
#include "app/programs.h"
#include "app/run_program.h"

namespace {

constexpr const char* kIntroduction =
    "voxmelt melts solid voxel models and lets them flow, with an exact cellular automaton.\n\n"
    "  voxmelt run cello                    melt the cello: frames, contact sheet and report in out/cello\n"
    "  voxmelt run cello_viscous --steps 800\n"
    "  voxmelt run lava --set flow.paper.share=0.1 --out /tmp/lava\n"
    "  voxmelt digest goblet --steps 10 --every 1    one line per step; equal lines mean equal bits\n"
    "  voxmelt export bunny --steps 500 --out bunny500 --format vti\n"
    "  voxmelt render lava --steps 1200 --size 1280x960 --out lava.png\n"
    "  voxmelt verify lava --from 400 --set hw.lanes=16     the hardware model in lock-step with the "
    "software\n"
    "  voxmelt bench --quick                how fast, and how near to what this machine can do\n"
    "  voxmelt accuracy --quick             how well, against what mathematics says\n"
    "  voxmelt run bunny --checkpoint-every 60s, and after a power cut: voxmelt run --resume out/bunny\n"
    "  voxmelt new candle mine.toml         a scene with comments, to begin from\n"
    "  voxmelt sweep plan.toml              many runs that differ in some keys, and one table\n"
    "  voxmelt list scenes\n\n"
    "A scene is a TOML file; docs/scenes.md explains its keys. Exit codes: 0 done, 1 a check failed,\n"
    "2 bad usage or input, 3 out of memory or disk, 4 interrupted.";

}  // namespace

int main(int argc, char** argv) {
  using namespace voxmelt::app;
  // Commands are added in the order of --help.
  const auto add_commands = [&](CommandLine& program) {
    become_program(argc, argv);
    add_run(program);
    add_digest(program);
    add_export(program);
    add_render(program);
    for (const Elsewhere& row : kElsewhere)
      if (row.there) program.add(std::string(row.command), std::string(row.description));
    add_info(program);
    add_new(program);
    add_list(
        program,
        {{"implementations", list_implementations}, {"scenes", list_scenes}, {"features", list_features}});
  };
  return run_program(kIntroduction, add_commands, argc, argv);
}
