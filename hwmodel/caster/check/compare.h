// The checker's comparison of one number, or of several with one name, is here for the files that implement
// it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <utility>

#include "hwmodel/caster/check/checker.h"

namespace voxmelt::hwmodel::raycast {

template <class Value>
std::string text_of_value(const Value& value) {
  if constexpr (std::is_same_v<Value, Vec>) {
    return fmt::format("{} {} {}", value.x, value.y, value.z);
  } else if constexpr (std::is_enum_v<Value>) {
    return fmt::format("{}", static_cast<int>(value));
  } else if constexpr (std::is_arithmetic_v<Value>) {
    return fmt::format("{}", value);
  } else {
    return fmt::format("{}", fmt::join(value, " "));
  }
}

template <class Value>
void Checker::compare(const char* stage, const RayId& id, const char* name, const Value& expected,
                      const Value& actual, const Vec* position) {
  ++compared_;
  if (expected == actual || difference_) [[likely]]
    return;
  Difference difference;
  difference.stage = stage;
  difference.name = name;
  difference.x = id.x;
  difference.y = id.y;
  difference.sample = id.sample;
  difference.expected = text_of_value(expected);
  difference.actual = text_of_value(actual);
  difference.has_position = position != nullptr;
  if (position != nullptr) difference.position = *position;
  tell(std::move(difference));
}

}  // namespace voxmelt::hwmodel::raycast
