// The real sequences, where they are at hand (LIFT_SLAM_DATA).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lift_slam/datasets/prefetching_sequence.h"
#include "lift_slam/slam/run_for_test.h"
#include "lift_slam/testing/real_data.h"

namespace lift_slam {
namespace {

struct RealRun {
  RunRecord run;
  EvaluationResult result;
};

RealRun RunReal(const std::string& name, const std::string& truth = "") {
  SequenceOptions options;
  if (!truth.empty()) options.ground_truth_file = RealDataFolder() / truth;
  auto sequence = OpenSequence((RealDataFolder() / name).string(), options);
  const auto ground_truth = sequence->info().ground_truth;
  TestRunOptions run_options;
  run_options.mode = RunMode::kThreaded;
  RealRun real;
  real.run = RunSequence(std::make_unique<PrefetchingSequence>(std::move(sequence)), run_options);
  EvaluationOptions evaluation;
  if (ground_truth && ground_truth->by_index) {
    evaluation.association.method = AssociationMethod::kIndex;
  }
  real.result = Evaluate(real.run.final_trajectory,
                         ground_truth ? ground_truth->poses : Trajectory(), evaluation);
  std::cout << name << ": coverage " << real.result.coverage.coverage << ", ATE "
            << (real.result.ate_m ? real.result.ate_m->rmse : NAN) << " m\n";
  return real;
}

// Lengths of the steps from frame to frame, where both have a pose.
std::vector<double> StepLengths(const Trajectory& trajectory) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const TrajectoryPose &before = trajectory[i - 1], &now = trajectory[i];
    if (before.state != PoseState::kOk || now.state != PoseState::kOk) continue;
    steps.push_back((now.world_from_cam.translation - before.world_from_cam.translation).norm());
  }
  return steps;
}

// The largest ratio of two neighbouring steps; steps below `least` count as `least`, since the
// noise of a standing camera has no length to compare.
double LargestStepRatio(const std::vector<double>& steps, double least) {
  double largest = 1.0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double a = std::max(steps[i - 1], least), b = std::max(steps[i], least);
    largest = std::max(largest, std::max(a, b) / std::min(a, b));
  }
  return largest;
}

TEST(StepRatio, SeesAJump) {
  EXPECT_DOUBLE_EQ(LargestStepRatio({1.0, 1.1, 1.0, 3.0, 1.0}, 0.1), 3.0);
  EXPECT_DOUBLE_EQ(LargestStepRatio({0.01, 0.02, 0.001}, 0.1), 1.0);
}

class RealSlam : public testing::Test {
 protected:
  void SetUp() override {
    if (RealDataFolder().empty()) GTEST_SKIP() << "no real data: set LIFT_SLAM_DATA";
  }
};

TEST_F(RealSlam, Kitti00) {
  const RealRun real = RunReal("kitti/sequences/00", "kitti/poses_cut/00.txt");
  EXPECT_EQ(real.result.status, RunStatus::kOk);
  EXPECT_GE(real.result.coverage.coverage, 0.95);
  ASSERT_TRUE(real.result.ate_m);
  EXPECT_LE(real.result.ate_m->rmse, 0.36);
}

TEST_F(RealSlam, Kitti06) {
  const RealRun real = RunReal("kitti/sequences/06", "kitti/poses_cut/06.txt");
  EXPECT_GE(real.result.coverage.coverage, 0.9);
  ASSERT_TRUE(real.result.ate_m);
  EXPECT_LE(real.result.ate_m->rmse, 0.05);
}

TEST_F(RealSlam, KittiRawDriveHasNoJump) {
  const RealRun real = RunReal("kitti_raw/2011_09_26/2011_09_26_drive_0005_sync");
  EXPECT_GE(real.result.coverage.coverage, 0.95);
  EXPECT_EQ(real.run.num_maps, 1);
  const std::vector<double> steps = StepLengths(real.run.final_trajectory);
  ASSERT_GE(steps.size(), 100U);
  const double ratio = LargestStepRatio(steps, 0.1 * Median(steps));
  std::cout << "largest ratio of neighbouring steps " << ratio << "\n";
  EXPECT_LE(ratio, 1.5);
}

TEST_F(RealSlam, EurocStillCameraNeverInitialises) {
  const RealRun real = RunReal("euroc/V1_01_easy_static30");
  EXPECT_EQ(real.result.status, RunStatus::kFailInit);
  EXPECT_GE(CountOf(real.run, FrameRefusal::kLowParallax), 25);
}

TEST_F(RealSlam, RedKitchen) {
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "takes minutes in a debug build or under a sanitizer";
#endif
  const RealRun real = RunReal("7scenes_redkitchen");
  EXPECT_EQ(real.result.status, RunStatus::kOk);
  EXPECT_GE(real.result.coverage.coverage, 0.9);
  ASSERT_TRUE(real.result.ate_m);
  EXPECT_LE(real.result.ate_m->rmse, 0.052);
}

// The camera is carried on while 201 frames are missing. The motion before them predicts a wrong
// place, in which points enough agree to be tracked: 0.5 m off, and nothing says lost.
TEST_F(RealSlam, RedKitchenIsFoundInTheRightPlaceAfterMissingFrames) {
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "takes minutes in a debug build or under a sanitizer";
#endif
  auto sequence = OpenSequence((RealDataFolder() / "7scenes_redkitchen").string(), {});
  const Trajectory truth = sequence->info().ground_truth->poses;
  TestRunOptions options;
  options.mode = RunMode::kThreaded;
  options.vocabulary = ShippedOrbVocabulary();
  options.change_frame = [](InputFrame& frame) {
    if (frame.frame_index >= 300 && frame.frame_index <= 500) {
      frame.refusal = FrameRefusal::kImageUnreadable;
    }
  };
  options.frame_done = [](const FrameRecord& frame) { return frame.frame_index < 531; };
  const RunRecord run =
      RunSequence(std::make_unique<PrefetchingSequence>(std::move(sequence)), options);
  EXPECT_EQ(run.counters.at("tracking.gaps_in_time"), 1);
  for (std::size_t i = 501; i < run.frames.size(); ++i) {
    EXPECT_EQ(run.frames[i].state, TrackingState::kTracking) << i;
  }
  // As given when each frame was processed: a loop that repairs the map later does not count.
  const EvaluationResult result = Evaluate(run.online_trajectory, truth, EvaluationOptions());
  ASSERT_TRUE(result.ate_m);
  std::cout << "largest error " << result.ate_m->max << " m\n";
  EXPECT_LE(result.ate_m->max, 0.12);
}

}  // namespace
}  // namespace lift_slam
