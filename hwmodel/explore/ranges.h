// No number of a family is exact. The answer is sought again where all of them are at their better ends,
// where all are at their worse ones, and with each alone at both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/explore/sweep.h"

namespace voxmelt::hwmodel::explore {

// Describes a number of the device or its family that has a range.
struct Coefficient {
  std::string name;                         // as --set has it: "family.stage.melt.lut", "device.clock"
  std::string source;                       // "counted: ..."
  double value = 0, better = 0, worse = 0;  // a device with its better end has room for more
};
std::vector<Coefficient> coefficients_of(const Device& device);
// Returns the device with another value of one number.
Device with_value(Device device, const std::string& name, double value);

// Has the best design at both ends of one number or of all; none if nothing fits.
struct Ends {
  std::optional<Point> better, worse;
  std::int64_t span() const { return (better ? better->speed : 0) - (worse ? worse->speed : 0); }
};
struct Alone {
  Coefficient coefficient;
  Ends ends;
  bool keeps_best = true;  // does the best design still fit at the worse end?
};
struct Fullest {
  double better = 0, worse = 0;  // as Taken::fullest
};

struct Ranges {
  Ends all;
  bool keeps_best = true;        // does it fit with every number at its worse end?
  std::vector<Alone> alone;      // those that matter to this scene's designs, the widest span first
  std::vector<Fullest> fullest;  // of each point of the sweep
  double seconds = 0;
};

// `best` is the best point of `swept`, if any fits.
Ranges ranges_of(const Question& question, const Axes& axes, const Swept& swept,
                 std::optional<std::size_t> best, const std::function<void()>& poll);

}  // namespace voxmelt::hwmodel::explore
