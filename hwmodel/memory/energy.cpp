#include "hwmodel/memory/energy.h"

#include <cstdint>

#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel::memory {

double standby_of_a_row(const Rail& rail, const Parameters& p) {
  return (rail.idd3n * p.ras + rail.idd2n * (p.rc - p.ras)) / p.rc;
}

double nanoseconds_of(const Counts& counts, const Parameters& p) {
  return static_cast<double>(counts.cycles()) / p.channels * 1000 / p.mhz;
}

Energy energy_of(const Counts& counts, const Parameters& p) {
  const auto times = [](std::int64_t count) { return static_cast<double>(count); };
  const double columns = p.columns_of_request();
  const double closed = times(counts.cycles() * p.ranks - counts.active);
  Energy sum;
  for (const Rail& rail : p.rails) {
    // A volt, a milliampere and a nanosecond make a picojoule.
    const double cycle = 1e-3 * rail.volts * p.parts * 1000 / p.mhz;
    sum.activate += cycle * times(counts.activates) * p.rc * (rail.idd0 - standby_of_a_row(rail, p));
    sum.read += cycle * times(counts.reads) * columns * p.beats() * (rail.idd4r - rail.idd3n);
    sum.write += cycle * times(counts.writes) * columns * p.beats() * (rail.idd4w - rail.idd3n);
    sum.refresh += cycle * times(counts.refreshes) * p.rfc * (rail.idd5 - rail.idd3n);
    // A refresh of banks takes the share of its rows.
    sum.refresh +=
        cycle * times(counts.bank_refreshes) * ratio(p.refi_bank, p.refi) * p.rfc * (rail.idd5 - rail.idd3n);
    sum.background += cycle * (times(counts.active) * rail.idd3n + closed * rail.idd2n);
  }
  return sum;
}

}  // namespace voxmelt::hwmodel::memory
