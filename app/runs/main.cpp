// The program voxmelt-runs has the commands of voxmelt for many runs. `voxmelt` starts it.
#include "app/commands.h"
#include "app/run_program.h"

int main(int argc, char** argv) {
  using namespace voxmelt::app;
  const auto add_commands = [](CommandLine& program) {
    add_sweep(program);
    add_plot(program);
  };
  return run_program("Many runs of voxmelt.", add_commands, argc, argv);
}
