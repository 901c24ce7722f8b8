#include "lift_slam/simulation/motion/speed_profile.h"

#include <gtest/gtest.h>

#include "lift_slam/simulation/motion/road_path.h"
#include "lift_slam/simulation/motion/test_roads.h"

namespace lift_slam {
namespace {

class OvalSpeed : public ::testing::Test {
 protected:
  static SpeedOptions Fast() {
    SpeedOptions options;
    options.top_m_s = 25.0;
    return options;
  }
  double Curvature(double s) const { return path_.At(s).curvature_per_m; }
  SpeedProfile Profile(const SpeedOptions& options) const {
    return {[this](double s) { return Curvature(s); }, path_.LengthM(), options};
  }
  RoadPath path_{OvalRoad(), 4.0};
};

TEST_F(OvalSpeed, KeepsAllLimits) {
  const SpeedOptions options = Fast();
  const SpeedProfile profile = Profile(options);
  for (double s = 0.0; s < path_.LengthM(); s += 0.37) {
    const double v = profile.SpeedAt(s);
    EXPECT_LE(v, options.top_m_s + 1e-9);
    EXPECT_LE(v * v * std::abs(Curvature(s)), options.max_lateral_m_s2 * 1.02) << s;
    EXPECT_LE(profile.AccelerationAt(s), options.max_acceleration_m_s2 + 1e-9);
    EXPECT_GE(profile.AccelerationAt(s), -options.max_deceleration_m_s2 - 1e-9);
  }
}

TEST_F(OvalSpeed, BrakesBeforeCurvesAndIsFastOnStraights) {
  const SpeedProfile profile = Profile(Fast());
  const double in_curve = profile.SpeedAt(200.0 + 47.0), on_straight = profile.SpeedAt(110.0);
  EXPECT_NEAR(in_curve, std::sqrt(2.5 * 30.0), 1.0);
  EXPECT_GT(on_straight, in_curve + 6.0);
  EXPECT_LT(profile.AccelerationAt(170.0), -1.0);
  EXPECT_GT(profile.AccelerationAt(40.0), 1.0);
}

TEST_F(OvalSpeed, IsSmoothAcrossTheSeam) {
  const SpeedProfile profile = Profile(Fast());
  const double length = path_.LengthM();
  EXPECT_NEAR(profile.SpeedAt(length - 1e-6), profile.SpeedAt(1e-6), 1e-5);
  EXPECT_NEAR(profile.AccelerationAt(length - 1e-6), profile.AccelerationAt(1e-6), 1e-5);
}

TEST_F(OvalSpeed, ConstantSpeedIgnoresCurves) {
  SpeedOptions options = Fast();
  options.constant = true;
  const SpeedProfile profile = Profile(options);
  for (double s = 0.0; s < path_.LengthM(); s += 9.1) EXPECT_NEAR(profile.SpeedAt(s), 25.0, 1e-9);
}

TEST_F(OvalSpeed, DistanceGrowsByTheSpeed) {
  const SpeedProfile profile = Profile(Fast());
  const DistanceOverTime distance(profile, 30.0, 900.0);
  EXPECT_EQ(distance.DistanceM(0.0), 0.0);
  EXPECT_NEAR(distance.DistanceM(distance.DurationS()), 900.0, 1e-3);
  EXPECT_EQ(distance.DistanceM(-1.0), 0.0);
  for (double t = 0.5; t < distance.DurationS() - 0.5; t += 0.613) {
    const double difference = (distance.DistanceM(t + 1e-4) - distance.DistanceM(t - 1e-4)) / 2e-4;
    EXPECT_NEAR(difference, distance.SpeedM_s(t), 1e-3);
  }
}

}  // namespace
}  // namespace lift_slam
