// Operations on two 16-bit numbers, each with every value of the first, agree with kernel/automaton/rule or
// with integers. VOXMELT_SLOW takes every value of the second, too. Otherwise the test takes 257 of them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/gravity.h"
#include "kernel/automaton/rule/heat.h"
#include "tests/kernel/engine/cpu/lane_fixture.h"

namespace voxmelt::cpu {
namespace {

#ifdef VOXMELT_SLOW
constexpr bool kSlow = true;
#else
constexpr bool kSlow = false;
#endif
constexpr int kDithers[] = {0, 1, 0x5A5A, 0x8000, 0xFFFE, 0xFFFF};

class Rows : public LanesTest {
 protected:
  Rows() : rows_(std::make_unique<Two>()) {
    for (std::size_t a = 0; a < kAllValues; ++a) rows_->all[a] = static_cast<std::uint16_t>(a);
  }

  // Expects f(a, s, r) for every a.
  template <class F>
  void expect(RowOperation operation, int s, int r, const F& f) {
    const std::uint16_t *all = rows_->all.data(), *got = rows_->got.data();
    own_.row(operation, s, r, all, rows_->got.data());
    int wrong = 0;
    for (int a = 0; a < 65536; ++a) wrong |= got[a] ^ (f(a, s, r) & 0xFFFF);
    if (wrong == 0) return;
    for (int a = 0; a < 65536; ++a)
      ASSERT_EQ(got[a], f(a, s, r) & 0xFFFF) << "a " << a << ", s " << s << ", r " << r;
  }
  // Takes s = 0..65535, every `every`-th value, and the last.
  template <class F>
  void expect_all(RowOperation operation, int r, int every, const F& f) {
    for (int s = 0; s < 65535; s += every) ASSERT_NO_FATAL_FAILURE(expect(operation, s, r, f));
    ASSERT_NO_FATAL_FAILURE(expect(operation, 65535, r, f));
  }
  template <class F>
  void expect_all(RowOperation operation, int r, const F& f) {
    expect_all(operation, r, kSlow ? 1 : 255, f);
  }

  struct Two {
    Row<kAllValues> all, got;
  };
  std::unique_ptr<Two> rows_;
};
INSTANTIATE_TEST_SUITE_P(Sets, Rows, testing::ValuesIn(kInstructionSets), test_name);

unsigned product(int a, int s) { return static_cast<unsigned>(a) * static_cast<unsigned>(s); }

TEST_P(Rows, ShareOfAnAmountIsTheRules) {
  expect_all(RowOperation::high, 0, [](int a, int s, int) { return rule::scaled(a, s); });
}

TEST_P(Rows, FrictionIsTheRulesWithEveryDither) {
  for (const int dither : kDithers) {
    const auto f = [](int e, int alpha, int d) { return rule::scaled(e, alpha, d); };
    expect_all(RowOperation::dithered, dither, f);
    if (!kSlow || dither == 0x5A5A) expect_all(RowOperation::carried, dither, f);
  }
}

TEST_P(Rows, WhatFallsIsTheRules) {
  const auto f = [](int a, int factor, int least) {
    return rule::released(a, static_cast<std::uint32_t>(factor), least);
  };
  expect_all(RowOperation::given, 0, f);
  expect_all(RowOperation::given, 32, kSlow ? 16 : 255, f);
  expect_all(RowOperation::given, 65535, 255, f);
  for (const int least : {0, 1, 32, 65535})
    ASSERT_NO_FATAL_FAILURE(expect(RowOperation::given, 65536, least, f));
}

TEST_P(Rows, ProductsAreWhole) {
  expect_all(RowOperation::low, 0,
             [](int a, int s, int) { return static_cast<int>(product(a, s) & 0xFFFF); });
  expect_all(RowOperation::product_low, 0, 255,
             [](int a, int s, int) { return static_cast<int>(product(a, s) & 0xFFFF); });
  expect_all(RowOperation::product_high, 0, 255,
             [](int a, int s, int) { return static_cast<int>(product(a, s) >> 16); });
}

TEST_P(Rows, HalvesComeBackFromWideNumbers) {
  expect_all(RowOperation::unpack_low, 0, 255, [](int a, int, int) { return a; });
  expect_all(RowOperation::unpack_high, 0, 255, [](int, int s, int) { return s; });
}

TEST_P(Rows, ComparisonsAreUnsigned) {
  expect_all(RowOperation::less, 0, [](int a, int s, int) { return int{a < s}; });
  expect_all(RowOperation::more, 0, [](int a, int s, int) { return int{s < a}; });
  expect_all(RowOperation::equal, 0, [](int a, int s, int) { return int{a == s}; });
}

TEST_P(Rows, MinimaMaximaAndSaturation) {
  expect_all(RowOperation::min, 0, [](int a, int s, int) { return std::min(a, s); });
  expect_all(RowOperation::max, 0, [](int a, int s, int) { return std::max(a, s); });
  expect_all(RowOperation::add_saturated, 0, [](int a, int s, int) { return std::min(a + s, 65535); });
  expect_all(RowOperation::sub_saturated, 0, [](int a, int s, int) { return std::max(a - s, 0); });
  expect_all(RowOperation::sub_saturated_from, 0, [](int a, int s, int) { return std::max(s - a, 0); });
}

TEST_P(Rows, MeansAreRoundedUp) {
  expect_all(RowOperation::mean, 0, [](int a, int s, int) { return (a + s + 1) / 2; });
}

TEST_P(Rows, MasksChooseLanes) {
  expect_all(RowOperation::keep, 0, 255, [](int a, int s, int) { return a < s ? a : 0; });
  for (const int r : {0, 1, 4096, 32768, 65535}) {
    expect_all(RowOperation::select, r, 255, [](int a, int s, int b) { return a < s ? b : a; });
    expect_all(RowOperation::add_if, r, 255, [](int a, int s, int b) { return a < s ? a + b : a; });
    expect_all(RowOperation::sub_if, r, 255, [](int a, int s, int b) { return a < s ? a - b : a; });
  }
}

TEST_P(Rows, TemperatureIsTheRules) {
  for (const int latent : {1, 100, 4096, 32768, 65535})
    expect_all(RowOperation::temperature, latent, 255, [](int h, int melting, int l) {
      rule::Material material;
      material.melting_point = static_cast<rule::Temperature>(melting);
      material.latent_heat = static_cast<rule::Temperature>(l);
      return rule::temperature_of(h, material);
    });
}

// |difference| weight < 2^31 holds for weights up to 32767.
TEST_P(Rows, ConductionIsTheRules) {
  for (const int weight : {0, 1, 3, 819, 5000, 16384, 20861, 32767})
    for (const int dither : kDithers) {
      const int both = weight << 16 | dither;
      const bool whole = kSlow && dither == 0x5A5A && (weight == 5000 || weight == 32767);
      expect_all(RowOperation::conducted, both, whole ? 1 : 1021, [](int second, int first, int r) {
        return rule::conducted(first, second, r >> 16, r & 0xFFFF);
      });
    }
}

TEST_P(Rows, ConvectionIsTheRules) {
  for (const int dither : kDithers)
    for (int weight = 0; weight < 32768; weight += 127)
      ASSERT_NO_FATAL_FAILURE(expect(RowOperation::falling, weight, dither, [](int lower, int w, int d) {
        return rule::convected(lower, 0, w, d);
      }));
}

}  // namespace
}  // namespace voxmelt::cpu
