// Whole rendered sequences: the trajectory must agree with the exact poses.
#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"

namespace lift_slam {
namespace {

struct Path {
  SyntheticPath path;
  int num_frames;
  double frame_rate_hz;
  double max_ate_m;
};

class RenderedSequence : public testing::TestWithParam<Path> {};

TEST_P(RenderedSequence, IsTrackedAccurately) {
  const Path& path = GetParam();
  const auto sequence = SmallSequence(path.path, path.num_frames, path.frame_rate_hz);
  const RunRecord run = RunSynthetic(sequence);
  const EvaluationResult result = Judge(run, TrueTrajectory(sequence));
  ASSERT_EQ(result.status, RunStatus::kOk);
  EXPECT_GE(result.coverage.coverage, 0.95);
  EXPECT_EQ(result.coverage.lost_events, 0);
  EXPECT_EQ(run.num_maps, 1);
  ASSERT_TRUE(result.ate_m) << result.no_errors_reason;
  EXPECT_LE(result.ate_m->rmse, path.max_ate_m);
  RecordProperty("ate_mm", static_cast<int>(result.ate_m->rmse * 1e3));
  std::cout << "ATE " << result.ate_m->rmse << " m, coverage " << result.coverage.coverage
            << ", keyframes " << run.keyframes.size() << ", points " << run.points.size() << "\n";
}

INSTANTIATE_TEST_SUITE_P(All, RenderedSequence,
                         testing::Values(Path{SyntheticPath::kStreetDrive, 60, 10.0, 0.15},
                                         Path{SyntheticPath::kRoomSway, 90, 30.0, 0.015},
                                         Path{SyntheticPath::kRoomLoop, 200, 10.0, 0.03}),
                         [](const auto& tested) { return std::string(Name(tested.param.path)); });

// What the run leaves behind must fit together.
TEST(SlamSystem, LeavesAConsistentRecord) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomSway, 40, 15.0);
  const RunRecord run = RunSynthetic(sequence);
  ASSERT_EQ(run.frames.size(), 40U);
  ASSERT_EQ(run.final_trajectory.size(), 40U);
  ASSERT_EQ(run.online_trajectory.size(), 40U);
  ASSERT_GE(run.keyframes.size(), 2U);
  ASSERT_GE(run.points.size(), 100U);
  int refused = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FrameRecord& frame = run.frames[i];
    EXPECT_EQ(frame.frame_index, static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.world_from_cam.has_value(), frame.refusal == FrameRefusal::kNone);
    EXPECT_EQ(run.online_trajectory[i].state == PoseState::kOk, frame.world_from_cam.has_value());
    refused += frame.refusal != FrameRefusal::kNone ? 1 : 0;
  }
  EXPECT_EQ(CountOf(run, FrameRefusal::kNone), 40 - refused);
  EXPECT_TRUE(std::ranges::is_sorted(run.keyframes, {}, [](const KeyFrameRecord& keyframe) {
    return keyframe.pose.timestamp_ns;
  }));
  for (const PointRecord& point : run.points) {
    EXPECT_TRUE(point.position.allFinite());
    EXPECT_GE(point.observations.size(), 2U);
    EXPECT_LT(point.reprojection_error_px, 10.0F);
    for (const auto& observation : point.observations) {
      EXPECT_LT(static_cast<std::size_t>(observation.keyframe), run.keyframes.size());
    }
  }
}

}  // namespace
}  // namespace lift_slam
