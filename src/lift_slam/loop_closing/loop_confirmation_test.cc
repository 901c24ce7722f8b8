#include "lift_slam/loop_closing/loop_confirmation.h"

#include <gtest/gtest.h>

#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

// A map whose units are half a metre goes along x, one metre a keyframe; the candidates' world is
// in metres, and its origin is 50 m from where the map has keyframe 0.
class LoopConfirmationTest : public testing::Test {
 protected:
  LoopConfirmationTest() {
    for (int i = 0; i < 40; ++i) {
      map_.AddKeyFrame(scene_.MakeFrame(i, {Eigen::Quaterniond::Identity(), {-2.0 * i, 0.0, 0.0}}));
    }
  }
  // Of a keyframe that is at x (metres) in the candidates' world.
  static Sim3d At(double x, double scale = 2.0) {
    return {scale, Eigen::Quaterniond::Identity(), {-scale * x, 0.0, 0.0}};
  }

  SyntheticFrames scene_{10, 5.0, 10.0, 3};
  Map map_{scene_.view()};
  LoopConfirmation confirmation_{LoopConfirmationOptions()};
};

TEST_F(LoopConfirmationTest, OneKeyFrameAloneIsNotBelieved) {
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(20), At(50.0), map_));
}

TEST_F(LoopConfirmationTest, PlaceThatMovesOnWithTheCameraIsBelieved) {
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(20), At(50.0), map_));
  EXPECT_TRUE(confirmation_.Confirms(KeyFrameId(22), At(52.2), map_));
}

TEST_F(LoopConfirmationTest, PlaceThatStaysWhileTheCameraMovesIsNot) {
  for (int i = 20; i < 30; ++i) {
    EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(i), At(50.0), map_)) << i;
  }
}

TEST_F(LoopConfirmationTest, PlaceThatMovesOnAtAnotherScaleIsNot) {
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(20), At(50.0, 1.0), map_));
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(22), At(52.0, 1.0), map_));
}

TEST_F(LoopConfirmationTest, AnyRecentClaimMayAgreeAndOldOnesMayNot) {
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(10), At(40.0), map_));
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(11), At(7.0), map_));
  EXPECT_TRUE(confirmation_.Confirms(KeyFrameId(13), At(43.0), map_));
  confirmation_.Reset();
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(14), At(44.0), map_));
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(38), At(68.0), map_));
}

TEST_F(LoopConfirmationTest, ClaimOfAKeyFrameCulledSinceIsForgotten) {
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(20), At(50.0), map_));
  map_.EraseKeyFrame(KeyFrameId(20));
  EXPECT_FALSE(confirmation_.Confirms(KeyFrameId(22), At(52.0), map_));
}

}  // namespace
}  // namespace lift_slam
