// The pipeline has arithmetic of its own, written from docs/automaton.md alone. If it shared code with
// kernel/automaton/rule, their agreement would prove nothing.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "hwmodel/fabric/wires.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::hwmodel {

// Checks a wire whose width is known only when the design is configured.
inline std::int64_t wire(std::int64_t value, int bits) {
  if (value < 0 || value >> bits != 0) [[unlikely]]
    throw WidthError(value, bits, false);
  return value;
}
inline std::int64_t signed_wire(std::int64_t value, int bits) {
  if (value < -(std::int64_t{1} << (bits - 1)) || value >> (bits - 1) > 0) [[unlikely]]
    throw WidthError(value, bits, true);
  return value;
}

// Reads a table that is a memory of the machine.
template <class Table>
const auto& looked_up(const Table& table, std::int64_t address) {
  if (address < 0 || address >= std::ssize(table)) [[unlikely]]
    throw AddressError(address, std::ssize(table));
  return table[address];
}

// Returns floor((value x fraction + rounding) / 65536), by one signed multiplier of 17 x 17 bits.
inline std::int64_t scale(std::int64_t value, std::int64_t fraction, std::int64_t rounding = 0) {
  const SInt<17> a = value;
  const UInt<17> b = fraction;
  return (SInt<35>(std::int64_t{a} * std::int64_t{b} + UInt<16>(rounding))) >> 16;
}

// Returns the bit-reversed step counter, shifted by `part` of `parts`. It needs wires and one adder.
inline UInt<16> dither_of(std::uint32_t step, int part = 0, int parts = 1) {
  std::int64_t reversed = 0;
  for (int bit = 0; bit < 16; ++bit) reversed |= std::int64_t{step >> bit & 1u} << (15 - bit);
  return UInt<16>::truncated(reversed + 65536 * part / parts);
}

// Computes quotients by n, which the host knows. 1 / n is rounded up to a multiple of 2^-36, and so is too
// large by less than 2^-36. For numbers of 26 bits and n up to 2^10 that is too little to reach the next
// quotient.
class Reciprocal {
 public:
  explicit Reciprocal(std::int64_t n) : value_(((std::int64_t{1} << kShift) + n - 1) / n) {}
  std::int64_t times(std::int64_t number) const {
    return UInt<53>(UInt<26>(number) * std::int64_t{value_}) >> kShift;
  }
  std::int64_t value() const { return value_; }

 private:
  static constexpr int kShift = 36;
  UInt<37> value_;
};

// Returns the heat of a mixture, by one divider. `content` is the sum of amount x heat of its parts.
inline UInt<16> mix(std::int64_t content, std::int64_t amount, std::int64_t dither) {
  return (content + ((amount * dither) >> 16)) / amount;
}

// The directions stand in the order of a pattern's bits: +x -x +z -z, then the diagonals.
inline constexpr std::array<int, 8> kStepX{1, -1, 0, 0, 1, 1, -1, -1};
inline constexpr std::array<int, 8> kStepZ{0, 0, 1, -1, 1, -1, 1, -1};

}  // namespace voxmelt::hwmodel
