#include "lift_slam/nn/half_float.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lift_slam::nn {
namespace {

TEST(HalfFloat, EveryNumberComesBack) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    if ((bits & 0x7C00) == 0x7C00) {
      EXPECT_TRUE(std::isnan(FromHalf(half)));
    } else {
      EXPECT_EQ(ToHalf(FromHalf(half)), half) << bits;
    }
  }
}

TEST(HalfFloat, OthersAreRoundedToTheNearest) {
  EXPECT_EQ(ToHalf(1.0F), 0x3C00);
  EXPECT_EQ(ToHalf(1.0F + 0x1p-11F), 0x3C00);  // a tie, to even
  EXPECT_EQ(ToHalf(1.0F + 0x1p-11F + 0x1p-20F), 0x3C01);
  EXPECT_EQ(ToHalf(2.0F - 0x1p-20F), 0x4000);
  EXPECT_EQ(ToHalf(-0x1p-25F), 0x8000);
  EXPECT_EQ(ToHalf(0x1p-24F * 1.4F), 0x0001);
  EXPECT_EQ(ToHalf(65519.0F), 0x7BFF);
  EXPECT_EQ(ToHalf(65520.0F), 0x7C00);
  EXPECT_EQ(ToHalf(-std::numeric_limits<float>::infinity()), 0xFC00);
}

}  // namespace
}  // namespace lift_slam::nn
