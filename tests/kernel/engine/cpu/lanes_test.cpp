// Operations on whole vectors are tested, and those whose domain is too large to be gone through.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/random.h"
#include "tests/kernel/engine/cpu/lane_fixture.h"

namespace voxmelt::cpu {
namespace {

#ifdef VOXMELT_SLOW
constexpr int kRandomDivisions = 100'000'000;
#else
constexpr int kRandomDivisions = 10'000'000;
#endif
constexpr std::uint64_t kEvery = 0x0001000100010001u;  // 16 bits, four times
constexpr std::uint16_t kExtremes[] = {0, 1, 2, 0x7FFF, 0x8000, 0x8001, 0xFFFE, 0xFFFF};

using Numbers = std::mt19937_64;
std::uint16_t any_value(Numbers& random) {
  const std::uint64_t n = random();
  return n >> 62 == 0 ? kExtremes[n & 7] : static_cast<std::uint16_t>(n);
}
template <std::size_t size>
void fill(Row<size>& row, Numbers& random) {
  for (std::uint16_t& value : row) value = any_value(random);
}

class Vectors : public LanesTest {};
INSTANTIATE_TEST_SUITE_P(Sets, Vectors, testing::ValuesIn(kInstructionSets), test_name);

TEST_P(Vectors, BitsBecomeLanesAndComeBack) {
  Row<64> lanes;
  Numbers random(1);
  const auto expect = [&](std::uint64_t word) {
    ASSERT_EQ(own_.bits(word, lanes.data()), word);
    for (std::size_t i = 0; i < 64; ++i) ASSERT_EQ(lanes[i], (word >> i & 1) != 0 ? 0xFFFF : 0) << word;
  };
  for (std::uint64_t value = 0; value < 65536; ++value) ASSERT_NO_FATAL_FAILURE(expect(value * kEvery));
  for (int i = 0; i < 100'000; ++i) ASSERT_NO_FATAL_FAILURE(expect(random()));
  for (int i = 0; i < 64; ++i) ASSERT_NO_FATAL_FAILURE(expect(std::uint64_t{1} << i));
}

TEST_P(Vectors, ShiftsAndLookupOfEveryValue) {
  const auto all = std::make_unique<Row<kAllValues>>(), got = std::make_unique<Row<kAllValues>>();
  for (std::size_t a = 0; a < kAllValues; ++a) (*all)[a] = static_cast<std::uint16_t>(a);
  for (int by = 1; by <= 15; ++by) {
    own_.shift(true, by, all->data(), got->data());
    for (unsigned a = 0; a < kAllValues; ++a) ASSERT_EQ((*got)[a], (a << by) & 0xFFFF);
    own_.shift(false, by, all->data(), got->data());
    for (unsigned a = 0; a < kAllValues; ++a) ASSERT_EQ((*got)[a], a >> by);
  }
  Numbers random(2);
  for (int i = 0; i < 20; ++i) {
    Row<32> table;
    fill(table, random);
    own_.lookup(table.data(), all->data(), got->data());
    for (std::size_t a = 0; a < kAllValues; ++a) ASSERT_EQ((*got)[a], table[a >> 11]) << a;
  }
}

TEST_P(Vectors, LanesMoveUpByOne) {
  Row<64> previous, current, got;
  Numbers random(3);
  fill(previous, random);
  fill(current, random);
  own_.after(64, previous.data(), current.data(), got.data());
  const auto count = static_cast<std::size_t>(own_.count);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(got[i], i % count == 0 ? previous[i + count - 1] : current[i - 1]) << i;
}

TEST_P(Vectors, VectorsBesideAnAlignedOne) {
  Row<192> values;
  alignas(64) std::uint8_t bytes[192];
  Numbers random(8);
  fill(values, random);
  for (std::size_t i = 0; i < 192; ++i) bytes[i] = static_cast<std::uint8_t>(values[i] >> 5);
  const auto count = static_cast<std::size_t>(own_.count);
  for (std::size_t at = 64; at < 128; at += count) {
    Row<64> left, right;
    own_.beside(values.data() + at, left.data(), right.data());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(left[i], values[at + i - 1]) << at << " " << i;
      EXPECT_EQ(right[i], values[at + i + 1]) << at << " " << i;
    }
    own_.bytes_beside(bytes + at, left.data(), right.data());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(left[i], bytes[at + i - 1]) << at << " " << i;
      EXPECT_EQ(right[i], bytes[at + i + 1]) << at << " " << i;
    }
  }
}

TEST_P(Vectors, SignedProductsAddUpInPairs) {
  Row<64> a, b, c, d, low, high;
  alignas(64) std::int32_t sums[32];
  Numbers random(4);
  const auto signed_product = [](std::uint16_t x, std::uint16_t y) {
    return std::int64_t{static_cast<std::int16_t>(x)} * static_cast<std::int16_t>(y);
  };
  for (int round = 0; round < 100'000; ++round) {
    for (Row<64>* row : {&a, &b, &c, &d}) fill(*row, random);
    if (round == 0)
      for (Row<64>* row : {&a, &b, &c, &d}) row->fill(0x8000);
    own_.pair_product(64, a.data(), b.data(), c.data(), d.data(), low.data(), high.data());
    own_.pair_sums(64, a.data(), b.data(), sums);
    for (std::size_t i = 0; i < 64; ++i) {
      const auto sum = static_cast<std::uint32_t>(signed_product(a[i], b[i]) + signed_product(c[i], d[i]));
      ASSERT_EQ(std::uint32_t{high[i]} << 16 | low[i], sum) << round << ", lane " << i;
      if (i % 2 != 0) continue;
      const std::int64_t pair = signed_product(a[i], b[i]) + signed_product(a[i + 1], b[i + 1]);
      ASSERT_EQ(sums[i / 2], static_cast<std::int32_t>(pair)) << round << ", pair " << i / 2;
    }
  }
}

TEST_P(Vectors, SumsHoldAsManyVectorsAsTheySay) {
  const auto size = 32'768 * static_cast<std::size_t>(own_.count);
  const auto row = std::make_unique<Row<32'768 * 32>>();
  Numbers random(5);
  for (const auto& [total, most] : {std::pair{own_.total, 0xFFFF}, {own_.small_total, 0x7FFF}}) {
    row->fill(static_cast<std::uint16_t>(most));
    EXPECT_EQ(total(size, row->data()), size * static_cast<std::size_t>(most));
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      (*row)[i] = static_cast<std::uint16_t>(any_value(random) & most);
      sum += (*row)[i];
    }
    EXPECT_EQ(total(size, row->data()), sum) << most;
  }
}

// Collects divisions into rows.
class Divider {
 public:
  explicit Divider(const Operations& own) : own_(own) {}
  void add(std::uint64_t n, std::uint32_t d) {
    if (n >= std::uint64_t{d} << 16) return;  // more than 16 bits of quotient
    low_[used_] = static_cast<std::uint16_t>(n);
    high_[used_] = static_cast<std::uint16_t>(n >> 16);
    d_[used_] = static_cast<std::uint16_t>(d);
    if (++used_ == kSize) flush();
  }
  void flush() {
    for (std::size_t i = used_; i < kSize; ++i) {
      low_[i] = high_[i] = 0;
      d_[i] = 1;
    }
    own_.divide(kSize, low_.data(), high_.data(), d_.data(), quotient_.data(), remainder_.data());
    for (std::size_t i = 0; i < used_; ++i) {
      const std::uint32_t n = std::uint32_t{high_[i]} << 16 | low_[i], d = d_[i];
      const bool right = quotient_[i] == n / d && remainder_[i] == n % d;
      if (!right) ADD_FAILURE() << n << " / " << d << ": " << quotient_[i] << ", " << remainder_[i];
      wrong_ += !right;
    }
    used_ = 0;
  }
  bool wrong() const { return wrong_ > 0; }

 private:
  static constexpr std::size_t kSize = 4096;
  const Operations& own_;
  Row<kSize> low_, high_, d_, quotient_, remainder_;
  std::size_t used_ = 0;
  int wrong_ = 0;
};

// At multiples of every divisor a rounded quotient would cross to the next.
TEST_P(Vectors, DivisionIsExactAroundMultiples) {
  const auto divider = std::make_unique<Divider>(own_);
  Numbers random(6);
  std::vector<std::uint64_t> spread{1,    2,    3,     5,     100,   255,   256,   257,
                                    4095, 4096, 21845, 32767, 32768, 32769, 65534, 65535};
  spread.resize(spread.size() + 16);
  for (std::uint32_t d = 1; d < 65536 && !divider->wrong(); ++d) {
    for (std::size_t i = 16; i < spread.size(); ++i) spread[i] = 1 + random() % 65535;
    for (const std::uint64_t k : spread)
      for (const std::uint64_t n : {k * d - 1, k * d, k * d + 1}) divider->add(n, d);
    for (const std::uint64_t n : {std::uint64_t{0}, std::uint64_t{d} * 65536 - 1, std::uint64_t{0x7FFFFFFF},
                                  std::uint64_t{0x80000000}, std::uint64_t{0xFFFFFFFF}})
      divider->add(n, d);
  }
  divider->flush();
}

TEST_P(Vectors, DivisionIsExactAtRandom) {
  const auto divider = std::make_unique<Divider>(own_);
  Numbers random(7);
  for (int i = 0; i < kRandomDivisions && !divider->wrong(); ++i) {
    const std::uint64_t bits = random();
    const auto d = static_cast<std::uint32_t>((bits & 0xFFFF) >> (bits >> 60)) | 1u << (bits >> 56 & 7);
    divider->add(std::uint64_t{d} * ((bits >> 16) & 0xFFFF) + (bits >> 32 & 0xFFFF) % d, d);
  }
  divider->flush();
}

TEST_P(Vectors, MeanHeatIsTheRules) {
  constexpr std::size_t kSize = 4096;
  Row<kSize> a0, h0, a1, h1, got;
  Numbers random(8);
  for (int round = 0; round < 1000; ++round) {
    for (auto* row : {&a0, &h0, &a1, &h1}) fill(*row, random);
    for (std::size_t i = 0; i < kSize; ++i) {
      a0[i] = static_cast<std::uint16_t>(a0[i] >> (round % 14));
      if (a0[i] == 0xFFFF) a0[i] = 0xFFFE;
      a1[i] = static_cast<std::uint16_t>(1 + a1[i] % (0xFFFF - a0[i]));
      if (round % 3 == 0 && i % 2 == 0) h1[i] = h0[i];
    }
    const int dither = any_value(random);
    const std::int64_t rounded =
        own_.mix(kSize, dither, a0.data(), h0.data(), a1.data(), h1.data(), got.data());
    std::int64_t books = 0;
    for (std::size_t i = 0; i < kSize; ++i) {
      const std::uint64_t amount = std::uint64_t{a0[i]} + a1[i];
      const std::uint64_t content = std::uint64_t{a0[i]} * h0[i] + std::uint64_t{a1[i]} * h1[i];
      const std::int32_t mean = rule::mixed(content, amount, dither);
      ASSERT_EQ(got[i], mean) << a0[i] << " of " << h0[i] << ", " << a1[i] << " of " << h1[i] << ", "
                              << dither;
      books += static_cast<std::int64_t>(amount) * mean - static_cast<std::int64_t>(content);
    }
    ASSERT_EQ(rounded, books);
  }
}

TEST_P(Vectors, ComparisonsBecomeBytes) {
  alignas(64) std::uint16_t a[8][64], b[8][64];
  Numbers random(10);
  const auto count = static_cast<std::size_t>(own_.count);
  for (int round = 0; round < 20'000; ++round) {
    const std::uint64_t keep =
        round % 3 == 0 ? ~std::uint64_t{0} : random() & (round % 2 == 0 ? random() : ~0u);
    std::uint8_t expected[64] = {}, got[64] = {};
    std::uint64_t nonzero = 0;
    for (std::size_t i = 0; i < 2 * count; ++i) {
      for (std::size_t d = 0; d < 8; ++d) {
        a[d][i] = any_value(random);
        b[d][i] = random() % 4 == 0 ? a[d][i] : any_value(random);
        const bool set = a[d][i] >= b[d][i] && (keep >> i & 1) != 0;
        expected[i] = static_cast<std::uint8_t>(expected[i] | (set ? 1 << d : 0));
      }
      nonzero |= std::uint64_t{expected[i] != 0} << i;
    }
    ASSERT_EQ(own_.bytes(a, b, keep, got), nonzero) << round;
    for (std::size_t i = 0; i < 2 * count; ++i) ASSERT_EQ(got[i], expected[i]) << round << ", " << i;
  }
}

TEST_P(Vectors, BytesBecomeLanes) {
  Row<64> lanes, has, count;
  std::uint8_t bytes[65];
  for (int first = 0; first < 256; ++first)
    for (int bit = 0; bit < 8; ++bit) {
      for (int i = 0; i < 65; ++i) bytes[i] = static_cast<std::uint8_t>(first + 37 * i);
      own_.widen(bytes + 1, bit, lanes.data(), has.data(), count.data());  // from any address
      for (std::size_t i = 0; i < 64; ++i) {
        const unsigned byte = bytes[i + 1];
        ASSERT_EQ(lanes[i], byte);
        ASSERT_EQ(has[i], (byte >> bit & 1) != 0 ? 0xFFFF : 0) << byte << ", bit " << bit;
        ASSERT_EQ(count[i], std::popcount(byte & 15)) << byte;
      }
    }
}

TEST_P(Vectors, DiceAreTheRules) {
  Numbers random(9);
  std::uint8_t bytes[4 * 32];
  const auto count = static_cast<std::size_t>(own_.count);
  for (int round = 0; round < 20'000; ++round) {
    const rule::RoundKeys keys = rule::round_keys(random());
    const auto step =
        round < 4 ? 0u - static_cast<std::uint32_t>(round) : static_cast<std::uint32_t>(random());
    std::uint32_t blocks[2];
    // One block in four is near 2^32, where numbers of blocks turn over.
    for (std::uint32_t& block : blocks) {
      block = static_cast<std::uint32_t>(random());
      if (random() % 4 == 0) block |= 0xFFFFFFF8u;
    }
    own_.dice(keys.data(), step, blocks, bytes);
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const auto lane = static_cast<std::uint32_t>(i % (2 * count));
      const std::uint64_t block = rule::random_block(keys, step, blocks[i / (2 * count)] + lane / 8);
      ASSERT_EQ(bytes[i], rule::random_byte(block, static_cast<int>(lane))) << round << ", cell " << i;
    }
  }
}

}  // namespace
}  // namespace voxmelt::cpu
