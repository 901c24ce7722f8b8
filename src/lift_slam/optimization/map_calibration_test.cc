#include "lift_slam/optimization/map_calibration.h"

#include <gtest/gtest.h>

#include "lift_slam/optimization/map_bundle.h"
#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

constexpr double kFocalScale = 0.985;  // the true focal length over that the map believes in

// A map of 40 keyframes, made with the true camera and believed to be of a longer focal length.
class MapCalibrationTest : public testing::Test {
 protected:
  MapCalibrationTest() {
    ViewModel believed = *scene_.view();
    believed.pinhole.fx /= kFocalScale;
    believed.pinhole.fy /= kFocalScale;
    map_ = std::make_unique<Map>(std::make_shared<const ViewModel>(believed));
    std::vector<Rigid3d> cams_from_world;
    for (int k = 0; k < 40; ++k) {
      const double turn = 0.15 * std::sin(0.5 * k), tilt = 0.1 * std::cos(0.3 * k);
      const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
      cams_from_world.emplace_back(rotation,
                                   Eigen::Vector3d(0.4 * std::sin(0.2 * k), 0.0, 0.02 * k));
    }
    scene_.FillMap(cams_from_world, *map_);
    options_.max_keyframes = 20;
    options_.window_keyframes = 10;
    options_.focal_scale_sigma = 0.1;
    options_.focal_scale_error = 0.002;  // as far as the tests' estimates are off
  }

  SyntheticFrames scene_{300, 3.0, 9.0, 5};
  std::unique_ptr<Map> map_;
  SelfCalibrationOptions options_;
};

TEST_F(MapCalibrationTest, WindowsOfALongMapFindTheFocalLength) {
  ASSERT_FALSE(IsCalibratedAsAWhole(options_, *map_));
  const Rigid3d before = map_->keyframe(KeyFrameId(7)).cam_from_world;
  const SelfCalibrationReport report = EstimateCalibration(options_, *map_);
  ASSERT_TRUE(report.usable());
  EXPECT_NEAR(report.correction().focal_scale, kFocalScale, 2e-3);
  EXPECT_EQ(map_->keyframe(KeyFrameId(7)).cam_from_world.translation, before.translation);
}

TEST_F(MapCalibrationTest, TwoWindowsAreTakenHoweverLongTheyAreAskedFor) {
  options_.window_keyframes = 15;
  const SelfCalibrationReport report = EstimateCalibration(options_, *map_);
  ASSERT_TRUE(report.usable());
  EXPECT_NEAR(report.correction().focal_scale, kFocalScale, 2e-3);
}

TEST_F(MapCalibrationTest, BundleWithTheCorrectionAgreesWithThePixels) {
  const SelfCalibrationReport estimate = EstimateCalibration(options_, *map_);
  ASSERT_TRUE(estimate.usable());
  const MapBundleReport without = AdjustWholeMap({}, {}, *map_);
  const MapBundleReport with = AdjustWholeMap({}, estimate.correction(), *map_);
  ASSERT_TRUE(with.solver.usable);
  EXPECT_LT(with.solver.final_cost, 0.2 * without.solver.final_cost);
  EXPECT_EQ(with.free_keyframes, 40);
}

TEST_F(MapCalibrationTest, ShortMapIsCalibratedAsAWhole) {
  options_.max_keyframes = 40;
  ASSERT_TRUE(IsCalibratedAsAWhole(options_, *map_));
  const SelfCalibrationReport report = SelfCalibrateMap(options_, *map_);
  ASSERT_TRUE(report.usable());
  EXPECT_NEAR(report.correction().focal_scale, kFocalScale, 2e-3);
}

TEST_F(MapCalibrationTest, WhatIsNotClearlyOffStaysAsItIs) {
  const Rigid3d before = map_->keyframe(KeyFrameId(7)).cam_from_world;
  options_.focal_scale_error = 1.0 - kFocalScale;
  SelfCalibrationReport report = EstimateCalibration(options_, *map_);
  EXPECT_EQ(report.refusal, CalibrationRefusal::kNotClearlyOff);
  EXPECT_NEAR(report.estimate.focal_scale, kFocalScale, 2e-3);  // said all the same
  EXPECT_TRUE(report.correction().IsIdentity());
  options_.max_keyframes = 40;
  report = SelfCalibrateMap(options_, *map_);
  EXPECT_EQ(report.refusal, CalibrationRefusal::kNotClearlyOff);
  EXPECT_NEAR(report.estimate.focal_scale, kFocalScale, 2e-3);
  EXPECT_TRUE(report.correction().IsIdentity());
  EXPECT_EQ(map_->keyframe(KeyFrameId(7)).cam_from_world.translation, before.translation);
}

TEST_F(MapCalibrationTest, IsNotDoneWhenSwitchedOffOrWithFewKeyFrames) {
  options_.min_keyframes = 41;
  EXPECT_EQ(EstimateCalibration(options_, *map_).refusal, CalibrationRefusal::kFewKeyFrames);
  EXPECT_EQ(SelfCalibrateMap(options_, *map_).refusal, CalibrationRefusal::kFewKeyFrames);
  options_.min_keyframes = 20;
  options_.enabled = false;
  EXPECT_EQ(EstimateCalibration(options_, *map_).refusal, CalibrationRefusal::kSwitchedOff);
  EXPECT_EQ(SelfCalibrateMap(options_, *map_).refusal, CalibrationRefusal::kSwitchedOff);
}

}  // namespace
}  // namespace lift_slam
