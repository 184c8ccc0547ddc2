// Ctrl-C and similar signals end a command cleanly, so that nothing half-written is left behind.
#pragma once

namespace voxmelt::app {

// SIGINT, SIGTERM, SIGHUP and SIGQUIT. Until the first output is begun they end the program at once.
void end_at_interrupts();
void catch_interrupts();  // from now on somebody asks below
// Likewise; and who has not ended two seconds later is ended. What was not complete is removed.
void end_soon_at_interrupts();
bool interrupted();
bool interrupted_for_long();  // a second or more ago: what takes longer is given up
void stop_if_interrupted();   // throws Interrupted: nothing is written

}  // namespace voxmelt::app
