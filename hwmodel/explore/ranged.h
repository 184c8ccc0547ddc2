// A number of a device or a family is as good as its source, and has a range: the truth may lie anywhere in
// it.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace voxmelt::hwmodel::explore {

template <class T>
struct Ranged {
  T value{}, low{}, high{};
  std::string source{};  // "synthesised: ...", "counted: ..." or "assumed: ..."
};

// The truth behind a number whose file says no range may be so many times more or less.
struct Source {
  std::string_view name;
  double of_logic, of_device;  // LUTs and flip-flops; the device's clock and fill
};
// This is the one table, and its factors are judgement.
inline constexpr std::array kSources{Source{"synthesised", 1.25, 1.1}, Source{"counted", 2, 1.25},
                                     Source{"assumed", 3, 1.5}};

}  // namespace voxmelt::hwmodel::explore
