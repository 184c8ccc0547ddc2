// An enumerator is the index of its row in a table, and the number on its wires.
#pragma once

#include <cstddef>
#include <type_traits>

namespace voxmelt::hwmodel {

template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::size_t index_of(Enum one) { return static_cast<std::size_t>(one); }

}  // namespace voxmelt::hwmodel
