#include "app/run_program.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "app/ending.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/version.h"

namespace voxmelt::app {

namespace {

int run(const std::string& introduction, const std::function<void(CommandLine&)>& add_commands, int argc,
        char** argv) {
  try {
    CommandLine program("voxmelt", introduction, version_text());
    add_commands(program);
    open_standard_streams();
    // A file that grows too large and a pipe that is closed are error messages, not ends of the program.
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
    end_at_interrupts();
    const std::function<int()> work = program.read(argc, argv);
    const int code = work ? work() : kDone;
    return standard_output_is_well() ? code : kOutOfResources;
  } catch (const OutputStopped& stopped) {
    standard_output_is_well(stopped.error);
    return kOutOfResources;
  } catch (...) {
    const Ending ending = ending_of(std::current_exception());
    say(ending.message);
    return ending.code;
  }
}

}  // namespace

int run_program(const std::string& introduction, const std::function<void(CommandLine&)>& add_commands,
                int argc, char** argv) {
  const int code = run(introduction, add_commands, argc, argv);
  if (ends_at_once()) {
    std::cout.flush();
    std::fflush(nullptr);
    std::_Exit(code);
  }
  return code;
}

}  // namespace voxmelt::app
