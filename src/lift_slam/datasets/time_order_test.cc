#include "lift_slam/datasets/time_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lift_slam {
namespace {

using testing::ElementsAre;
using Stamps = std::vector<std::int64_t>;

TEST(KeepIncreasing, KeepsAllThatIncrease) {
  EXPECT_THAT(KeepIncreasing(Stamps{1, 2, 5}), ElementsAre(true, true, true));
  EXPECT_TRUE(KeepIncreasing(Stamps{}).empty());
}

TEST(KeepIncreasing, LeavesOutOneStampThatStepsBack) {
  EXPECT_THAT(KeepIncreasing(Stamps{0, 2, 1, 3}), ElementsAre(true, true, false, true));
}

TEST(KeepIncreasing, LeavesOutOneStampFarAhead) {
  EXPECT_THAT(KeepIncreasing(Stamps{0, 900, 1, 2, 3}), ElementsAre(true, false, true, true, true));
}

TEST(KeepIncreasing, KeepsTheFirstOfEqualStamps) {
  EXPECT_THAT(KeepIncreasing(Stamps{0, 1, 1, 1, 2}), ElementsAre(true, true, false, false, true));
}

TEST(MedianRate, IsThatOfMostSteps) {
  EXPECT_DOUBLE_EQ(MedianRateHz(Stamps{0, 100'000'000, 200'000'000, 900'000'000}), 10.0);
  EXPECT_EQ(MedianRateHz(Stamps{5}), 0.0);
}

}  // namespace
}  // namespace lift_slam
