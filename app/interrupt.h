// Ctrl-C and friends end a command in good order, instead of leaving a partial folder behind.
#pragma once

namespace voxmelt::app {

void catch_interrupts();  // SIGINT, SIGTERM, SIGHUP
bool interrupted();
void stop_if_interrupted();  // throws UsageError: nothing is written

}  // namespace voxmelt::app
