#include "app/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>

#include "app/options.h"

namespace voxmelt::app {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<Clock::rep> g_when{0};  // 0: never
static_assert(std::atomic<Clock::rep>::is_always_lock_free, "a signal may come at any moment");

void interrupt(int) {
  Clock::rep never = 0;
  g_when.compare_exchange_strong(never, Clock::now().time_since_epoch().count());
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    if (std::signal(signal, interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);  // as under nohup
}

bool interrupted() { return g_when != 0; }

bool interrupted_for_long() {
  return interrupted() && Clock::now() - Clock::time_point(Clock::duration(g_when)) > std::chrono::seconds(1);
}

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace voxmelt::app
