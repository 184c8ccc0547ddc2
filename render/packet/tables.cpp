#include "render/packet/tables.h"

#include <array>
#include <cstddef>

#include "render/rule/normal.h"

namespace voxmelt::render {

const picture::Tone& tone_table() {
  static const picture::Tone table = picture::tone_table();
  return table;
}

const picture::Bytes& byte_table() {
  static const picture::Bytes table = picture::byte_table();
  return table;
}

const std::uint32_t* inverse_roots() {
  static constexpr auto table = [] {
    std::array<std::uint32_t, picture::kInverseRoot.size() - 1> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = picture::kInverseRoot[i] | (picture::kInverseRoot[i] - picture::kInverseRoot[i + 1]) << 16;
    return values;
  }();
  return table.data();
}

}  // namespace voxmelt::render
