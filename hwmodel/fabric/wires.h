// Numbers have a declared width, as in hardware. A value that does not fit is a broken invariant, and never
// wraps silently.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace voxmelt::hwmodel {

// Reports what the hardware could not do, a broken invariant of the model. It is reported with its stage.
class ModelError : public std::logic_error {
  using std::logic_error::logic_error;
};

// Reports a value that needs more bits than its wire has.
class WidthError : public ModelError {
 public:
  WidthError(std::int64_t value, int bits, bool is_signed)
      : ModelError("the value " + std::to_string(value) + " does not fit into " + std::to_string(bits) +
                   (is_signed ? " signed bits" : " bits")) {}
};

// Reports an address that a memory does not have.
class AddressError : public ModelError {
 public:
  AddressError(std::int64_t address, std::int64_t words)
      : ModelError("the address " + std::to_string(address) + " lies outside a memory of " +
                   std::to_string(words) + " words") {}
};

// Models an unsigned wire or register of N bits.
template <int N>
class UInt {
  static_assert(N >= 1 && N <= 62);

 public:
  static constexpr int kBits = N;
  static constexpr std::int64_t kMax = (std::int64_t{1} << N) - 1;

  constexpr UInt() = default;
  constexpr UInt(std::int64_t value) : value_(static_cast<Storage>(value)) {
    if (value < 0 || value > kMax) [[unlikely]]
      throw WidthError(value, N, false);
  }
  constexpr operator std::int64_t() const { return value_; }

  // Drops the bits above N on purpose.
  static constexpr UInt truncated(std::int64_t value) { return UInt(value & kMax); }

 private:
  using Storage = std::conditional_t<
      N <= 8, std::uint8_t,
      std::conditional_t<N <= 16, std::uint16_t, std::conditional_t<N <= 32, std::uint32_t, std::uint64_t>>>;
  Storage value_ = 0;
};

// Models a signed (two's complement) wire or register of N bits.
template <int N>
class SInt {
  static_assert(N >= 2 && N <= 63);

 public:
  static constexpr int kBits = N;
  static constexpr std::int64_t kMax = (std::int64_t{1} << (N - 1)) - 1, kMin = -kMax - 1;

  constexpr SInt() = default;
  constexpr SInt(std::int64_t value) : value_(static_cast<Storage>(value)) {
    if (value < kMin || value > kMax) [[unlikely]]
      throw WidthError(value, N, true);
  }
  constexpr operator std::int64_t() const { return value_; }

 private:
  using Storage =
      std::conditional_t<N <= 16, std::int16_t, std::conditional_t<N <= 32, std::int32_t, std::int64_t>>;
  Storage value_ = 0;
};

// Returns the number of bits that hold 0..most.
constexpr int bits_for(std::int64_t most) {
  int bits = 1;
  while (most >> bits > 0) ++bits;
  return bits;
}

}  // namespace voxmelt::hwmodel
