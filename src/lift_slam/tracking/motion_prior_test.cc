#include "lift_slam/tracking/motion_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr int kFew = 100, kMany = 300, kFeatures = 2000;

Rigid3d CameraAt(double x) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(-x, 0.0, 0.0)};
}

class MotionPriorTest : public testing::Test {
 protected:
  // Of a frame that is expected `way` further on.
  double Sigma(double way = 1.0) {
    prior_.Expect(CameraAt(1.0), CameraAt(1.0 + way));
    return 1.0 / std::sqrt(prior_.For(kFew, kFeatures).inverse_variance);
  }
  void LearnChange(double ratio) {
    for (int i = 0; i < 500; ++i) {
      prior_.Expect(CameraAt(0.0), CameraAt(1.0));
      prior_.Learn(CameraAt(1.0 + ratio));
    }
  }

  MotionPrior prior_{{.min_match_share = 0.1, .min_change_ratio = 0.02}};
};

TEST_F(MotionPriorTest, IsWhereConstantVelocityLeads) {
  LearnChange(0.1);
  prior_.Expect(CameraAt(1.0), CameraAt(3.0));
  EXPECT_EQ(prior_.For(kFew, kFeatures).center_in_world, Eigen::Vector3d(3.0, 0.0, 0.0));
  EXPECT_GT(prior_.For(kFew, kFeatures).inverse_variance, 0.0);
}

TEST_F(MotionPriorTest, SaysNothingBeforeItKnowsWhatIsUsual) {
  for (int i = 0; i < 19; ++i) {
    prior_.Expect(CameraAt(0.0), CameraAt(1.0));
    prior_.Learn(CameraAt(1.1));
  }
  prior_.Expect(CameraAt(0.0), CameraAt(1.0));
  EXPECT_EQ(prior_.For(kFew, kFeatures).inverse_variance, 0.0);
  prior_.Learn(CameraAt(1.1));
  EXPECT_NEAR(Sigma(), 0.04, 1e-6);
}

TEST_F(MotionPriorTest, SaysNothingWhereTheFrameSeesEnoughOrNothingIsExpected) {
  LearnChange(0.1);
  prior_.Forget();
  EXPECT_EQ(prior_.For(kFew, kFeatures).inverse_variance, 0.0);
  prior_.Expect(CameraAt(1.0), CameraAt(3.0));
  EXPECT_EQ(prior_.For(kMany, kFeatures).inverse_variance, 0.0);
  prior_.Forget();
  EXPECT_EQ(prior_.For(kFew, kFeatures).inverse_variance, 0.0);
}

TEST_F(MotionPriorTest, IsSureOfASteadyCameraAndUnsureOfAnUnsteadyOne) {
  LearnChange(0.1);
  EXPECT_NEAR(Sigma(), 0.4 * 0.1, 0.001);
  LearnChange(0.5);
  EXPECT_NEAR(Sigma(), 0.4 * 0.5, 0.01);
  LearnChange(0.0);
  EXPECT_NEAR(Sigma(), 0.02, 1e-12);
}

TEST_F(MotionPriorTest, AFastCameraMayChangeMoreAndAStandingOneStart) {
  LearnChange(0.1);
  EXPECT_NEAR(Sigma(3.0), 0.12, 0.003);
  for (int i = 0; i < 10000; ++i) {
    prior_.Expect(CameraAt(0.0), CameraAt(1e-4));
    prior_.Learn(CameraAt(0.0));
  }
  EXPECT_NEAR(Sigma(0.0), 0.04, 0.001);
  prior_.Rescale(3.0);
  EXPECT_NEAR(Sigma(0.0), 0.12, 0.003);
}

TEST_F(MotionPriorTest, OneJumpChangesLittle) {
  LearnChange(0.1);
  prior_.Expect(CameraAt(0.0), CameraAt(1.0));
  prior_.Learn(CameraAt(50.0));
  EXPECT_LT(Sigma(), 0.042);
}

TEST_F(MotionPriorTest, OptionsOutOfRangeAreRefused) {
  EXPECT_NO_THROW(MotionPriorOptions().Check());
  EXPECT_THROW((MotionPriorOptions{.min_match_share = -0.1}.Check()), InputError);
  EXPECT_THROW((MotionPriorOptions{.min_change_ratio = 0.0}.Check()), InputError);
}

}  // namespace
}  // namespace lift_slam
