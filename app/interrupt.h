// Ctrl-C and similar signals end a command cleanly, so that no partial folder is left behind.
#pragma once

namespace voxmelt::app {

// SIGINT, SIGTERM, SIGHUP and SIGQUIT. Until the first output is begun they end the program at once.
void end_at_interrupts();
void catch_interrupts();  // from now on somebody asks below
bool interrupted();
bool interrupted_for_long();  // a second or more ago: what takes longer is given up
void stop_if_interrupted();   // throws Interrupted: nothing is written

}  // namespace voxmelt::app
