// A range tells the allowed values of a number in a scene file. It is built by name: at_most(1),
// above(0).at_most(71), within(360).
#pragma once

#include <string>
#include <utility>

namespace voxmelt::scene {

struct Range {
  double lowest = 0, highest = 1;
  bool above = false;    // the lowest value itself is not allowed
  std::string why = {};  // follows the upper bound in the message: "the bound for 6 neighbours"

  Range because(std::string reason) && {
    why = std::move(reason);
    return std::move(*this);
  }
};

struct LowerBound {
  double lowest;
  bool above;

  Range at_most(double highest) const { return {.lowest = lowest, .highest = highest, .above = above}; }
};

inline LowerBound above(double lowest) { return {.lowest = lowest, .above = true}; }
inline LowerBound at_least(double lowest) { return {.lowest = lowest, .above = false}; }
inline Range at_most(double highest) { return at_least(0).at_most(highest); }  // not negative
inline Range within(double reach) { return at_least(-reach).at_most(reach); }  // on both sides of 0

}  // namespace voxmelt::scene
