#include "lift_slam/optimization/calibration_consensus.h"

#include <gtest/gtest.h>

#include <vector>

namespace lift_slam {
namespace {

TEST(Consensus, PartsThatAgreeAreBelieved) {
  const std::vector<CalibrationCorrection> parts = {{0.985, 0.010}, {0.986, 0.011}, {0.984, 0.009}};
  const CalibrationCorrection agreed = Consensus(parts, {});
  EXPECT_NEAR(agreed.focal_scale, 0.985, 2e-4);
  EXPECT_NEAR(agreed.k1, 0.010, 2e-4);
}

TEST(Consensus, OnePartThatIsFarOffIsNot) {
  const std::vector<CalibrationCorrection> parts = {
      {1.0, 0.0}, {0.998, -0.001}, {1.2, 0.12}, {1.001, 0.001}};
  const CalibrationCorrection agreed = Consensus(parts, {});
  EXPECT_NEAR(agreed.focal_scale, 1.0, 3e-3);
  EXPECT_NEAR(agreed.k1, 0.0, 3e-3);
}

TEST(Consensus, FocalLengthAndDistortionThatDifferTogetherAreDrawnTogether) {
  // f + 0.5 k1 is 1 everywhere: only that is known.
  const std::vector<CalibrationCorrection> parts = {{0.99, 0.02}, {1.0, 0.0}, {0.96, 0.08}};
  const CalibrationCorrection agreed = Consensus(parts, {});
  EXPECT_NEAR(agreed.focal_scale + 0.5 * agreed.k1, 1.0, 1e-3);
}

TEST(Consensus, NoCorrectionStaysNone) {
  const std::vector<CalibrationCorrection> parts(3);
  EXPECT_TRUE(Consensus(parts, {}).IsIdentity());
}

}  // namespace
}  // namespace lift_slam
