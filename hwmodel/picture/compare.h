// The checker's comparison of one number, or of several with one name: for the files that implement it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>

#include "hwmodel/picture/checker.h"

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
  difference_ = Difference{stage,
                           name,
                           id.x,
                           id.y,
                           id.sample,
                           caster_.cycle(),
                           text_of_value(expected),
                           text_of_value(actual),
                           position != nullptr ? *position : Vec{},
                           position != nullptr};
  caster_.stop();
}

}  // namespace voxmelt::hwmodel::raycast
