#include "app/progress.h"

#include <unistd.h>

#include "app/print.h"

namespace voxmelt::app {

Progress::Progress(std::uint32_t steps, bool quiet, std::uint32_t begun_at)
    : steps_(steps), begun_at_(begun_at), on_(!quiet && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_) put_error("\n");
}

void Progress::show(std::uint32_t done, const state::Volume& volume) {
  const auto now = Clock::now();
  if (!on_ || (done < steps_ && shown_ && now - last_ < std::chrono::milliseconds(250))) return;
  last_ = now;
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = seconds > 0 ? (done - begun_at_) / seconds : 0;
  const double left = rate > 0 ? (steps_ - done) / rate : 0;
  const double liquid = static_cast<double>(volume.liquid.count());
  const double matter = liquid + static_cast<double>(volume.solid.count());
  print_error("\rstep {}/{}  {:.1f} steps/s  liquid {:.0f} %  {:.0f} s left   ", done, steps_, rate,
              matter > 0 ? 100 * liquid / matter : 0, left);
}

}  // namespace voxmelt::app
