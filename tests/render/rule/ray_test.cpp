// Steps are tested by hand, and the samples in a box against a look at each.
#include "render/rule/ray.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {
namespace {

TEST(Ray, StepKeepsTheRatio) {
  // With 3 : -2 : 1, 3 x 2^30 is just below 2^32. Shrunk by 2^14, the largest is below a quarter of a cell.
  const std::int64_t one = std::int64_t{1} << 30;
  EXPECT_EQ(step_along({3 * one, -2 * one, one}, 2), (Vector{3 << 16, -(2 << 16), 1 << 16}));
  EXPECT_EQ(step_along({3 * one, -2 * one, one}, 0), (Vector{3 << 18, -(2 << 18), 1 << 18}));
  // The longest step is rounded up to the whole.
  EXPECT_EQ(step_along({(one << 1) - 1, 0, -one}, 1), (Vector{kCell / 2, 0, -kCell / 4}));
}

TEST(Ray, SamplesInABoxByHand) {
  const Vector low{0, 0, 0}, high{10, 10, 10};
  const auto is = [&](const Ray& ray, std::int64_t first, std::int64_t last) {
    const Samples got = samples_in(ray, low, high);
    EXPECT_EQ(got.first, first);
    EXPECT_EQ(got.last, last);
  };
  is({{-7, 5, 5}, {3, 0, 0}}, 3, 5);   // -7 -4 -1 [2 5 8] 11
  is({{-6, 5, 5}, {3, 0, 0}}, 2, 5);   // -6 -3 [0 3 6 9] 12
  is({{12, 5, 5}, {-3, 0, 0}}, 1, 4);  // 12 [9 6 3 0] -3
  is({{10, 5, 5}, {-5, 0, 0}}, 1, 2);  // 10 is outside
  is({{5, 5, 5}, {1, 1, -1}}, 0, 4);   // from within
  is({{5, 10, 5}, {1, 0, 0}}, 0, -1);  // beside
  EXPECT_GT(samples_in({{20, 5, 5}, {3, 0, 0}}, low, high).first,
            samples_in({{20, 5, 5}, {3, 0, 0}}, low, high).last);  // behind
}

TEST(Ray, SamplesInABoxAreThoseThatAreInIt) {
  std::mt19937 random(7);
  const auto within = [&](int low, int high) -> std::int64_t {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  for (int i = 0; i < 20000; ++i) {
    const Vector low{within(-9, 9), within(-9, 9), within(-9, 9)};
    const Vector high = low + Vector{within(1, 30), within(1, 30), within(1, 30)};
    const Ray ray{{within(-60, 60), within(-60, 60), within(-60, 60)},
                  {within(-6, 6), within(-6, 6), within(1, 6) * (i % 2 == 0 ? 1 : -1)}};
    const Samples got = samples_in(ray, low, high);
    for (std::int64_t k = 0; k < 150; ++k) {  // after 150 samples it is behind the box
      const Vector at = ray.at(k);
      const bool inside =
          at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y && at.z >= low.z && at.z < high.z;
      ASSERT_EQ(inside, k >= got.first && k <= got.last) << i << ", sample " << k;
    }
  }
}

}  // namespace
}  // namespace voxmelt::picture
