// Ctrl-C and similar signals end a command cleanly, so that nothing half-written is left behind.
#pragma once

namespace voxmelt::app {

// Handles SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1 and SIGXCPU. Until the first output is begun they end the
// program at once.
void end_at_interrupts();
void catch_interrupts();  // from now on the program itself asks the functions below
// Does the same, and ends a program that has not ended two seconds after the signal. Incomplete output is
// removed.
void end_soon_at_interrupts();
bool interrupted();
bool interrupted_for_long();  // the signal came a second or more ago; longer work is given up
void stop_if_interrupted();   // throws Interrupted: nothing is written

}  // namespace voxmelt::app
