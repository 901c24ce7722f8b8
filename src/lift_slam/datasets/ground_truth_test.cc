#include "lift_slam/datasets/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(MissingOverlap, GivesBothRangesAndSuspectsUnits) {
  Trajectory truth(2);
  truth[0].timestamp_ns = 1'000'000'000;
  truth[1].timestamp_ns = 2'500'000'000;
  EXPECT_EQ(DescribeMissingOverlap(truth, 2'000'000'000, 9'000'000'000), std::nullopt);
  const auto apart = DescribeMissingOverlap(truth, 3'000'000'000, 4'000'000'000);
  ASSERT_TRUE(apart);
  EXPECT_THAT(*apart, AllOf(HasSubstr("1.000000000 s to 2.500000000 s"),
                            HasSubstr("3.000000000 s to 4.000000000 s")));
  EXPECT_THAT(*apart, testing::Not(HasSubstr("mixed up")));
  const auto units =
      DescribeMissingOverlap(truth, 3'000'000'000'000'000'000, 3'000'000'001'000'000'000);
  ASSERT_TRUE(units);
  EXPECT_THAT(*units, HasSubstr("seconds and nanoseconds mixed up?"));
}

}  // namespace
}  // namespace lift_slam
