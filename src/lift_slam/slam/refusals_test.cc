// Inputs from which no map can be made: the run says why, for every frame.
#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"

namespace lift_slam {
namespace {

// Nothing was mapped, and every frame was refused.
void ExpectNoMap(const RunRecord& run, int num_frames) {
  EXPECT_EQ(run.num_maps, 0);
  EXPECT_TRUE(run.points.empty());
  EXPECT_EQ(CountOf(run, FrameRefusal::kNone), 0);
  ASSERT_EQ(run.final_trajectory.size(), static_cast<std::size_t>(num_frames));
  for (const TrajectoryPose& pose : run.final_trajectory) {
    EXPECT_EQ(pose.state, PoseState::kNotInitialized);
  }
  EXPECT_EQ(Judge(run, {}).status, RunStatus::kFailInit);
}

TEST(NeverInitialises, RotationOnTheSpot) {
  const RunRecord run = RunSynthetic(SmallSequence(SyntheticPath::kRoomRotation, 60, 20.0));
  ExpectNoMap(run, 60);
  EXPECT_GT(CountOf(run, FrameRefusal::kPureRotation) + CountOf(run, FrameRefusal::kLowParallax),
            30);
}

TEST(NeverInitialises, StillCamera) {
  const RunRecord run = RunSynthetic(SmallSequence(SyntheticPath::kRoomStill, 30, 20.0));
  ExpectNoMap(run, 30);
  EXPECT_EQ(CountOf(run, FrameRefusal::kLowParallax), 29);
}

TEST(NeverInitialises, BlackImages) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomSway, 20, 20.0);
  TestRunOptions options;
  options.change_frame = [&](InputFrame& frame) { frame.image = PlainImage(sequence.camera, 0); };
  const RunRecord run = RunSynthetic(sequence, options);
  ExpectNoMap(run, 20);
  EXPECT_EQ(CountOf(run, FrameRefusal::kTooFewFeatures), 20);
}

TEST(NeverInitialises, OneFrame) {
  const RunRecord run = RunSynthetic(SmallSequence(SyntheticPath::kRoomSway, 1, 20.0));
  ExpectNoMap(run, 1);
  EXPECT_EQ(CountOf(run, FrameRefusal::kFirstFrame), 1);
}

TEST(NeverInitialises, NoFrame) {
  ExpectNoMap(RunSynthetic(SmallSequence(SyntheticPath::kRoomSway, 0, 20.0)), 0);
}

TEST(SlamSystem, UnreadableFramesAreSkippedAndCounted) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomSway, 60, 20.0);
  TestRunOptions options;
  options.change_frame = [](InputFrame& frame) {
    if (frame.frame_index % 10 != 5) return;
    frame.image = GrayImage();
    frame.refusal = FrameRefusal::kImageUnreadable;
  };
  const RunRecord run = RunSynthetic(sequence, options);
  EXPECT_EQ(CountOf(run, FrameRefusal::kImageUnreadable), 6);
  EXPECT_EQ(run.lost_events, 0);
  const EvaluationResult result = Judge(run, TrueTrajectory(sequence));
  // All other frames are there: 54 of 60.
  EXPECT_EQ(result.coverage.frames_ok, 54);
  ASSERT_TRUE(result.ate_m);
  EXPECT_LE(result.ate_m->rmse, 0.02);
}

}  // namespace
}  // namespace lift_slam
