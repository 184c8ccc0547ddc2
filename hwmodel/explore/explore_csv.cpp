#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/explore/explore_report.h"

namespace voxmelt::hwmodel::explore {

std::string csv_of(const Explored& explored) {
  std::string text;
  for (const HwKey& key : kHwKeys)
    if (key.chosen()) text += std::string(key.name) + ',';
  text +=
      "clock_mhz,cycles,cycles_on_memory,cell_steps_per_second,femtojoules,memory_femtojoules,lut,ff,dsp,"
      "bram,uram,lutram,fullest,fullest_"
      "better,fullest_worse,fits,"
      "on_front,verified,simulated_cycles,simulated_on_memory\n";
  std::vector<bool> on_front(explored.swept.points.size());
  for (const std::size_t at : explored.answer.front) on_front[at] = true;
  for (std::size_t i = 0; i < explored.swept.points.size(); ++i) {
    const Point& p = explored.swept.points[i];
    for (const HwKey& key : kHwKeys)
      if (key.chosen()) text += fmt::format("{},", key.get(p.hw));
    text += fmt::format("{},{},{},{}000,{},{}", p.clock_mhz, p.cycles, p.on_memory, p.speed, p.energy,
                        p.memory_energy);
    for (const std::int64_t amount : p.taken.amounts) text += fmt::format(",{}", amount);
    text += fmt::format(",{},{:.6f},{:.6f},{:.6f},{},{}", p.taken.lutram, p.taken.fullest,
                        explored.ranges.fullest[i].better, explored.ranges.fullest[i].worse,
                        p.taken.fits() ? 1 : 0, on_front[i] ? 1 : 0);
    const Checked* checked = on_front[i] ? checked_at(explored, i) : nullptr;
    text += checked == nullptr ? ",0,,\n"
                               : fmt::format(",{},{},{}\n", checked->verified() ? 1 : 0, checked->cycles,
                                             checked->on_memory);
  }
  return text;
}

}  // namespace voxmelt::hwmodel::explore
