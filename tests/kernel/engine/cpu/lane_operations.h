// Declares single operations of one instruction set as plain functions on arrays. A test calls them from code
// that was compiled for every processor.
#pragma once

#include <cstddef>
#include <cstdint>

namespace voxmelt::cpu {

inline constexpr std::size_t kAllValues = 65536;

enum class RowOperation {
  high,
  low,
  product_high,  // high half of the 32-bit product
  product_low,
  unpack_high,  // high half of a + 65536 s
  unpack_low,
  dithered,  // friction: (a s + r) >> 16
  carried,   // the same by `carry`
  given,     // falling liquid: part s of a, s = 0..65535, and r more
  less,      // 1 or 0
  more,
  equal,
  min,
  max,
  add_saturated,
  sub_saturated,
  sub_saturated_from,
  mean,    // (a + s + 1) >> 1
  select,  // a < s ? r : a
  keep,    // a < s ? a : 0
  add_if,  // a < s ? a + r : a
  sub_if,
  temperature,  // temperature at heat a; melting point s, latent heat r
  conducted,    // heat from s to a; weight r >> 16, dither r & 0xFFFF
  falling,      // a s >> 16 with the dither r of conduction
};

struct Operations {
  int count;  // lanes
  // Does one operation on 65536 values of a, aligned to 64 bytes.
  void (*row)(RowOperation, int s, int r, const std::uint16_t* a, std::uint16_t* out);
  void (*shift)(bool left, int by, const std::uint16_t* a, std::uint16_t* out);
  void (*lookup)(const std::uint16_t* table, const std::uint16_t* index, std::uint16_t* out);
  // Expands a word to 64 lanes, and returns the word from the lanes. It checks `nonzero`, too, and returns
  // another word if that is wrong.
  std::uint64_t (*bits)(std::uint64_t word, std::uint16_t* lanes);
  // Computes n / d, with n given by halves. `size` is a multiple of 64, here and below.
  void (*divide)(std::size_t size, const std::uint16_t* low, const std::uint16_t* high,
                 const std::uint16_t* d, std::uint16_t* quotient, std::uint16_t* remainder);
  // Computes a b + c d, signed.
  void (*pair_product)(std::size_t size, const std::uint16_t* a, const std::uint16_t* b,
                       const std::uint16_t* c, const std::uint16_t* d, std::uint16_t* low,
                       std::uint16_t* high);
  void (*pair_sums)(std::size_t size, const std::uint16_t* a, const std::uint16_t* b, std::int32_t* out);
  void (*after)(std::size_t size, const std::uint16_t* previous, const std::uint16_t* current,
                std::uint16_t* out);
  // Loads vectors beginning at `at` - 1 and at `at` + 1, and does the same for bytes.
  void (*beside)(const std::uint16_t* at, std::uint16_t* left, std::uint16_t* right);
  void (*bytes_beside)(const std::uint8_t* at, std::uint16_t* left, std::uint16_t* right);
  std::uint64_t (*total)(std::size_t size, const std::uint16_t* a);
  std::uint64_t (*small_total)(std::size_t size, const std::uint16_t* a);  // every lane is below 32,768
  // Computes the mean heat of two parts. Returns the rounding, in lanes with a1 > 0.
  std::int64_t (*mix)(std::size_t size, int dither, const std::uint16_t* a0, const std::uint16_t* h0,
                      const std::uint16_t* a1, const std::uint16_t* h1, std::uint16_t* out);
  // For two neighbouring vectors, bit d of byte i is set unless a[d] < b[d] in that lane. It is kept where
  // `keep` has a bit. The same is done by bits, with bit i for lane i. Returns the lanes with a byte that is
  // not 0, or the complement if the two ways differ.
  std::uint64_t (*bytes)(const std::uint16_t (*a)[64], const std::uint16_t (*b)[64], std::uint64_t keep,
                         std::uint8_t* bytes);
  // Widens 64 bytes to lanes. Sets lanes that have a bit to all ones, and counts the lowest four bits that
  // are set.
  void (*widen)(const std::uint8_t* bytes, int bit, std::uint16_t* lanes, std::uint16_t* has,
                std::uint16_t* count);
  // Computes the bytes of two pairs of vectors of `count` cells.
  void (*dice)(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
               std::uint8_t* bytes);
};

// Returns the operations, compiled for an architecture of xsimd (lane_loops.h).
template <class Arch>
Operations operations_for();

}  // namespace voxmelt::cpu
