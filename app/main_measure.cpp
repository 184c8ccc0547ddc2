// The program voxmelt-measure has the commands of voxmelt that measure speed and error. `voxmelt` starts it.
#include "accuracy/case.h"
#include "app/commands.h"
#include "app/print.h"
#include "app/run_program.h"

namespace voxmelt::app {
namespace {

void list_cases() {
  for (const accuracy::Case& one : accuracy::all_cases()) print("{:<24} {}\n", one.name, one.title);
}

}  // namespace
}  // namespace voxmelt::app

int main(int argc, char** argv) {
  using namespace voxmelt::app;
  const auto add_commands = [](CommandLine& program) {
    add_bench(program);
    add_accuracy(program);
    add_list(program, {{"cases", list_cases}});
  };
  return run_program("Speed and error of voxmelt.", add_commands, argc, argv);
}
