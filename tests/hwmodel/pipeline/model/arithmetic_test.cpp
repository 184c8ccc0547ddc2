// The model's arithmetic is tested where worlds of a few cells hardly reach.
#include "hwmodel/pipeline/model/arithmetic.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace voxmelt::hwmodel {
namespace {

// A quotient is right everywhere if it is right at each multiple of n and at the number before it.
TEST(Reciprocal, GivesEveryQuotient) {
  for (std::int64_t n = 1; n <= 1024; ++n) {
    const Reciprocal reciprocal(n);
    for (std::int64_t quotient = 0; quotient < 65536; ++quotient) {
      ASSERT_EQ(reciprocal.times(quotient * n), quotient) << "n = " << n;
      ASSERT_EQ(reciprocal.times(quotient * n + n - 1), quotient) << "n = " << n;
    }
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
