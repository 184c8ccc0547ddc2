// The values of --sweep are read.
#include "hwmodel/explore/values.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace voxmelt::hwmodel::explore {
namespace {

using Texts = std::vector<std::string>;

TEST(Values, AreListedDoubledOrAdded) {
  EXPECT_EQ(values_of("memory.channels=1..32").values, (Texts{"1", "2", "4", "8", "16", "32"}));
  EXPECT_EQ(values_of("memory.channels=3..20").values, (Texts{"3", "6", "12"})) << "24 is beyond";
  EXPECT_EQ(values_of("device.fill=0.5..0.9+0.1").values, (Texts{"0.5", "0.6", "0.7", "0.8", "0.9"}));
  EXPECT_EQ(values_of("device.clock=150,200,90").values, (Texts{"150", "200", "90"}));
  EXPECT_EQ(values_of("device.clock=150").values, Texts{"150"});
  EXPECT_EQ(values_of("device.clock=7..7").values, Texts{"7"});
  EXPECT_EQ(values_of("memory.interface_cycles=0..20+10").values, (Texts{"0", "10", "20"}));
  EXPECT_EQ(values_of("device.clock=1..64+1").values.size(), 64U);
  EXPECT_EQ(values_of("device.clock=150").key, "device.clock");
}

TEST(Values, OthersAreRefused) {
  for (const char* text :
       {"", "device.clock", "=3", "device.clock=", "device.clock=a", "device.clock=1,,2", "device.clock=1,2,",
        "device.clock=9..3", "device.clock=0..3", "device.clock=1..3+0", "device.clock=1..3+-1",
        "device.clock=1..65+1", "device.clock=1..", "device.clock=..3", "device.clock=1..x",
        "device.clock=nan..3", "device.clock=-4..-1"})
    EXPECT_THROW(values_of(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
