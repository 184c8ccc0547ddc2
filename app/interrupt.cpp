#include "app/interrupt.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string_view>

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

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

// Nothing but write() and _exit() may be called in a handler.
void end_at_once(int) {
  constexpr std::string_view kWords = "interrupted; nothing was written\n";
  (void)!::write(STDERR_FILENO, kWords.data(), kWords.size());
  ::_exit(kInterrupted);
}

void handle(void (*handler)(int)) {
  for (const int signal : kSignals)
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);  // as under nohup
}

}  // namespace

void end_at_interrupts() { handle(end_at_once); }

void catch_interrupts() { handle(interrupt); }

bool interrupted() { return g_when != 0; }

bool interrupted_for_long() {
  return interrupted() && Clock::now() - Clock::time_point(Clock::duration(g_when)) > std::chrono::seconds(1);
}

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace voxmelt::app
