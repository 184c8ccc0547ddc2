// The list of faults and the plan of one of them serve any machine.
#include "hwmodel/check/fault_plan.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace voxmelt::hwmodel::check {
namespace {

enum class Fault : std::uint8_t { none, first, second, third, end };
using Row = FaultInfo<Fault>;
struct Struck {
  std::string where;
  int x = 0;
};

constexpr Row kFirst{Fault::first, "first-one", "a", "x"}, kSecond{Fault::second, "second", "b", "y"},
    kThird{Fault::third, "third", "c", "z"};
constexpr std::array kAll{kFirst, kSecond, kThird};

// If a table lacks a fault, has it twice or has another order, the compiler notices.
static_assert(lists_all(kAll));
static_assert(!lists_all(std::array{kFirst, kSecond}));
static_assert(!lists_all(std::array{kFirst, kThird}));
static_assert(!lists_all(std::array{kSecond, kFirst, kThird}));
static_assert(!lists_all(std::array{kFirst, kFirst, kSecond, kThird}));

TEST(FaultPlan, FaultsAreFoundByName) {
  const std::span<const Row> rows(kAll);
  ASSERT_NE(find_fault(rows, "second"), nullptr);
  EXPECT_EQ(find_fault(rows, "second")->fault, Fault::second);
  EXPECT_EQ(find_fault(rows, "secon"), nullptr);
  EXPECT_EQ(find_fault(rows, ""), nullptr);
}

TEST(FaultPlan, AFaultStrikesOnceAndNotBeforeItsStep) {
  FaultPlan<Fault, Struck> plan(Fault::second, 7, "channel");
  EXPECT_FALSE(plan.armed(Fault::first, 9));
  EXPECT_FALSE(plan.armed(Fault::second, 6));
  EXPECT_TRUE(plan.armed(Fault::second, 7));
  EXPECT_TRUE(plan.armed(Fault::second)) << "where there are no steps";
  EXPECT_EQ(plan.channel(), "channel");
  plan.strike({"b", 3});
  EXPECT_FALSE(plan.armed(Fault::second, 8));
  EXPECT_FALSE(plan.armed(Fault::second));
  ASSERT_TRUE(plan.struck().has_value());
  EXPECT_EQ(plan.struck()->x, 3);
  const FaultPlan<Fault, Struck> nothing;
  EXPECT_FALSE(nothing.armed(Fault::first)) << "no fault is planted";
}

TEST(FaultPlan, PartsLiveAsLongAsThePlan) {
  const auto part = std::make_shared<int>(1);
  {
    FaultPlan<Fault, Struck> plan(Fault::first);
    plan.keep(part);
    EXPECT_EQ(part.use_count(), 2);
  }
  EXPECT_EQ(part.use_count(), 1);
}

}  // namespace
}  // namespace voxmelt::hwmodel::check
