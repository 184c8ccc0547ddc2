// Ctrl-C and similar signals end a command cleanly, so that no partial folder is left behind.
#pragma once

namespace voxmelt::app {

void catch_interrupts();  // SIGINT, SIGTERM, SIGHUP, SIGQUIT
bool interrupted();
bool interrupted_for_long();  // a second or more ago: what takes longer is given up
void stop_if_interrupted();   // throws Interrupted: nothing is written

}  // namespace voxmelt::app
