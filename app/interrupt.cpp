#include "app/interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string_view>
#include <thread>

#include "app/options.h"
#include "kernel/run/io/unfinished.h"

namespace voxmelt::app {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<Clock::rep> g_when{0};  // time of the first signal; 0: none came
static_assert(std::atomic<Clock::rep>::is_always_lock_free, "a signal may come at any moment");

sem_t g_came;  // a semaphore, which a signal handler may raise

void interrupt(int) {
  Clock::rep never = 0;
  if (g_when.compare_exchange_strong(never, Clock::now().time_since_epoch().count())) ::sem_post(&g_came);
}

// Batch systems send the last two before they kill.
constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGXCPU};

// A signal handler may call nothing but write() and _exit().
void end(std::string_view words) {
  (void)!::write(STDERR_FILENO, words.data(), words.size());
  ::_exit(kInterrupted);
}

void end_at_once(int) { end("interrupted; nothing was written\n"); }

// Memory of some gigabytes takes another second to give back.
constexpr std::chrono::seconds kPatience{2};

void end_when_late() {
  while (::sem_wait(&g_came) != 0) {
  }
  std::this_thread::sleep_for(kPatience);
  end(io::discard_unfinished() ? "interrupted\n" : "interrupted; nothing was written\n");
}

void handle(void (*handler)(int)) {
  for (const int signal : kSignals)
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);  // stays so under nohup
}

}  // namespace

void end_at_interrupts() { handle(end_at_once); }

void catch_interrupts() { handle(interrupt); }

void end_soon_at_interrupts() {
  ::sem_init(&g_came, 0, 0);
  std::thread(end_when_late).detach();
  catch_interrupts();
}

bool interrupted() { return g_when != 0; }

bool interrupted_for_long() {
  return interrupted() && Clock::now() - Clock::time_point(Clock::duration(g_when)) > std::chrono::seconds(1);
}

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

}  // namespace voxmelt::app
