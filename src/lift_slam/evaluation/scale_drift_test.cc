#include "lift_slam/evaluation/scale_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lift_slam {
namespace {

// A circle of 300 m in 1001 steps; the estimate's length of step i is divided by scale(i / 1000).
std::vector<PosePair> Circle(const std::function<double(double)>& scale) {
  std::vector<PosePair> pairs;
  Eigen::Vector3d before(50.0, 0.0, 0.0), estimate = Eigen::Vector3d::Zero();
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 6.0 * i / 1000.0;
    const Eigen::Vector3d now(50.0 * std::cos(angle), 50.0 * std::sin(angle), 0.0);
    estimate += (now - before) / scale(i / 1000.0);
    before = now;
    PosePair pair;
    pair.reference.translation = now;
    pair.estimate.translation = estimate;
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(ScaleDrift, ConstantScaleIsNone) {
  const auto drift = ComputeScaleDrift(Circle([](double) { return 7.0; }));
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->scale_of_piece.size(), 10U);
  EXPECT_NEAR(drift->last_over_first, 1.0, 1e-9);
  EXPECT_NEAR(drift->largest_over_smallest, 1.0, 1e-9);
}

TEST(ScaleDrift, SteadyGrowthIsSeenBetweenTheEnds) {
  const auto drift = ComputeScaleDrift(Circle([](double way) { return std::exp(way); }));
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->last_over_first, std::exp(0.9), 0.02);
}

TEST(ScaleDrift, ABulgeInTheMiddleIsSeenInTheSpreadOnly) {
  const auto drift =
      ComputeScaleDrift(Circle([](double way) { return way > 0.4 && way < 0.6 ? 1.5 : 1.0; }));
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->last_over_first, 1.0, 1e-9);
  EXPECT_NEAR(drift->largest_over_smallest, 1.5, 0.01);
}

TEST(ScaleDrift, JitterIsNoWay) {
  auto pairs = Circle([](double) { return 1.0; });
  for (std::size_t i = 500; i < pairs.size(); ++i) {
    pairs[i].estimate.translation.z() += i % 2 == 0 ? 0.1 : -0.1;
  }
  const auto drift = ComputeScaleDrift(pairs);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->last_over_first, 1.0, 0.06);
}

TEST(ScaleDrift, NothingWithoutWay) {
  EXPECT_FALSE(ComputeScaleDrift({}));
  EXPECT_FALSE(ComputeScaleDrift(std::vector<PosePair>(100)));
}

}  // namespace
}  // namespace lift_slam
