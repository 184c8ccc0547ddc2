// A change of the world is made between two steps, by hand or by a journal: a key of the scene and its new
// numbers, as text "KEY NUMBER ...".
//
//   heat_source.0.at X Y Z           .power P   .radius R   .direction X Y Z   .remove
//   heat_source.0.point X Y Z POWER  .sphere X Y Z RADIUS POWER     .sun X Y Z POWER   .sky POWER: becomes
//   one heat_source.add X Y Z POWER      a point; it gets the next number heat_source.add_sphere X Y Z RADIUS
//   POWER heat_source.add_sun X Y Z POWER  towards it heat_source.add_sky POWER vent.0.at X Y Z .radius R
//   .rate A     .temperature T     .remove vent.0.on    .off                always open, and never vent.add X
//   Y Z RADIUS RATE TEMPERATURE drain.0.at X Y Z                 .radius R  .rate A     .on    .off .remove
//   drain.add X Y Z RADIUS RATE
//   pour X Y Z RADIUS TEMPERATURE    a ball of liquid, see Simulation::pour
//   carve X Y Z RADIUS
//   flow.viscous.kappa 0.02          any other key that Simulation::set() takes
//
// Units and ranges are those of scene files. Text that is no change, and numbers out of their range, throw
// voxmelt::InputError, and nothing has changed then.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "library/journal/world.h"

namespace voxmelt::journal {

struct Change {
  std::string key;
  std::vector<double> numbers;

  friend bool operator==(const Change&, const Change&) = default;
};

Change read_change(std::string_view text);
std::string text_of(const Change& change);  // read_change() gives the same numbers again
void apply(const Change& change, World& world);

}  // namespace voxmelt::journal
