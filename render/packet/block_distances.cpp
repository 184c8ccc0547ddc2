#include "render/packet/block_distances.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace voxmelt::render {
namespace {

constexpr std::size_t kDigits = 5;

// The table turns the eight bits of a byte into eight bytes, the lowest first in memory.
constexpr auto kBytesOfBits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> values{};
  for (std::size_t bits = 0; bits < values.size(); ++bits)
    for (std::size_t i = 0; i < 8; ++i) values[bits][i] = static_cast<std::uint8_t>(bits >> i & 1);
  return values;
}();

// Holds blocks as bits. Rows lie along x, in words of 64.
class Bits {
 public:
  explicit Bits(const state::Grid& blocks)
      : words_((static_cast<std::size_t>(blocks.x) + 63) / 64),
        y_(blocks.y),
        z_(blocks.z),
        bits_(words_ * y_ * z_, 0) {}

  std::vector<std::uint64_t>& all() { return bits_; }
  std::uint64_t* row(std::size_t row) { return bits_.data() + row * words_; }
  std::size_t rows() const { return y_ * z_; }

  // Grows the set bits by one block in every direction. Bits beyond the rows' ends may be set, too. They
  // cannot come back farther than they went.
  void grow(std::vector<std::uint64_t>& room) {
    room.resize(bits_.size());
    for (std::size_t r = 0; r < rows(); ++r)
      for (std::size_t w = 0; w < words_; ++w) {
        const std::uint64_t here = bits_[r * words_ + w];
        std::uint64_t grown = here | here << 1 | here >> 1;
        if (w > 0) grown |= bits_[r * words_ + w - 1] >> 63;
        if (w + 1 < words_) grown |= bits_[r * words_ + w + 1] << 63;
        room[r * words_ + w] = grown;
      }
    along(room, bits_, words_, words_ * y_);
    along(bits_, room, words_ * y_, bits_.size());
    bits_.swap(room);
  }

 private:
  // Grows along an axis. There are `step` words from a place to the next, and `whole` words in a whole line.
  static void along(const std::vector<std::uint64_t>& from, std::vector<std::uint64_t>& to, std::size_t step,
                    std::size_t whole) {
    for (std::size_t first = 0; first < from.size(); first += whole) {
      const std::uint64_t* a = from.data() + first;
      std::uint64_t* b = to.data() + first;
      std::copy_n(a, whole, b);
      for (std::size_t i = step; i < whole; ++i) b[i] |= a[i - step];
      for (std::size_t i = 0; i + step < whole; ++i) b[i] |= a[i + step];
    }
  }

  std::size_t words_, y_, z_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace

// Grows the occupied blocks by one block in every direction, again and again. The distance of a block counts
// how often it is still dark. The counts are kept digit by digit.
std::vector<std::uint8_t> block_distances(const std::vector<std::uint8_t>& occupied,
                                          const state::Grid& blocks, int most) {
  Bits grown(blocks);
  const std::size_t x = blocks.x;
  for (std::size_t r = 0; r < grown.rows(); ++r)
    for (std::size_t i = 0; i < x; ++i) grown.row(r)[i / 64] |= std::uint64_t{occupied[r * x + i]} << i % 64;

  const std::size_t words = grown.all().size();
  std::array<std::vector<std::uint64_t>, kDigits> digits;
  for (auto& digit : digits) digit.assign(words, 0);
  std::vector<std::uint64_t> room;
  for (int d = 0; d < most; ++d) {
    if (d > 0) grown.grow(room);
    bool dark = false;
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t carry = ~grown.all()[w];
      dark = dark || carry != 0;
      for (auto& digit : digits) {
        const std::uint64_t both = digit[w] & carry;
        digit[w] ^= carry;
        carry = both;
      }
    }
    if (!dark) break;
  }

  std::vector<std::uint8_t> distances(occupied.size());
  const std::size_t row_words = (x + 63) / 64;
  for (std::size_t r = 0; r < grown.rows(); ++r)
    for (std::size_t i = 0; i < x; i += 8) {
      std::uint64_t bytes = 0;
      for (std::size_t digit = 0; digit < kDigits; ++digit) {
        std::uint64_t one;
        std::memcpy(&one, kBytesOfBits[digits[digit][r * row_words + i / 64] >> i % 64 & 255].data(),
                    sizeof one);
        bytes |= one << digit;
      }
      std::memcpy(distances.data() + r * x + i, &bytes, std::min<std::size_t>(8, x - i));
    }
  return distances;
}

}  // namespace voxmelt::render
