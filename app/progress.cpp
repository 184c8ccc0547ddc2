#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "app/print.h"

namespace voxmelt::app {

namespace {

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 120) return fmt::format("{} s", whole);
  if (whole < 7200) return fmt::format("{} min", whole / 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

Progress::Progress(std::uint32_t steps, bool quiet, std::uint32_t begun_at)
    : steps_(steps), begun_at_(begun_at), on_(!quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_ && terminal_) put_error("\n");
}

void Progress::show(std::uint32_t done, const run::Simulation& simulation) {
  const auto now = Clock::now();
  const bool last = done >= steps_ && terminal_;
  const std::chrono::milliseconds between{!terminal_ ? 60'000 : shown_ ? 250 : 0};
  if (!on_ || (!last && now - last_ < between)) return;
  last_ = now;
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = seconds > 0 ? (done - begun_at_) / seconds : 0;
  const double left = rate > 0 ? (steps_ - done) / rate : 0;
  const state::Volume& volume = simulation.volume();
  const double liquid = static_cast<double>(volume.liquid.count());
  const double matter = liquid + static_cast<double>(volume.solid.count());
  print_error("{}step {}/{}  {:.1f} steps/s  liquid {:.0f} %  {} left{}", terminal_ ? "\r" : "", done, steps_,
              rate, matter > 0 ? 100 * liquid / matter : 0, duration_text(left), terminal_ ? "   " : "\n");
}

}  // namespace voxmelt::app
