// What happens when a map is lost: blackened images in the middle of a run.
#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"

namespace lift_slam {
namespace {

constexpr double kFrameRateHz = 15.0;

// Frames from `first` on are black, up to `last` included.
RunRecord RunWithDarkness(const SyntheticSequenceOptions& sequence, int first, int last) {
  TestRunOptions options;
  options.change_frame = [&sequence, first, last](InputFrame& frame) {
    if (frame.frame_index < first || frame.frame_index > last) return;
    frame.image = PlainImage(sequence.camera, 0);
  };
  return RunSynthetic(sequence, options);
}

int FramesOfMap(const RunRecord& run, int map_index) {
  int count = 0;
  for (const FrameRecord& frame : run.frames) count += frame.map_index == map_index ? 1 : 0;
  return count;
}

TEST(Lost, BrieflyTheSameMapGoesOn) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomSway, 70, kFrameRateHz);
  const RunRecord run = RunWithDarkness(sequence, 45, 48);
  EXPECT_EQ(run.lost_events, 1);
  EXPECT_EQ(run.relocalisations, 1);
  EXPECT_EQ(run.num_maps, 1);
  const EvaluationResult result = Judge(run, TrueTrajectory(sequence));
  EXPECT_EQ(result.coverage.frames_ok, 66);
  ASSERT_TRUE(result.ate_m);
  EXPECT_LE(result.ate_m->rmse, 0.03);
}

TEST(Lost, ForLongASecondMapIsBegunAndTheFirstKept) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomLoop, 170, kFrameRateHz);
  const RunRecord run = RunWithDarkness(sequence, 60, 119);
  EXPECT_EQ(run.lost_events, 1);
  EXPECT_EQ(run.num_maps, 2);
  EXPECT_EQ(run.counters.at("tracking.maps_left"), 1);
  EXPECT_GE(FramesOfMap(run, 0), 45);
  EXPECT_GE(FramesOfMap(run, 1), 30);
  // Every frame with a final pose names its map, also those tracked backwards from its beginning.
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const bool has_pose = run.final_trajectory[i].state == PoseState::kOk;
    EXPECT_EQ(run.frames[i].map_index >= 0, has_pose) << i;
  }
  // Nothing is claimed for the dark frames, and each map is right by itself.
  for (int i = 60; i < 120; ++i) {
    EXPECT_EQ(run.final_trajectory[static_cast<std::size_t>(i)].state, PoseState::kLost) << i;
  }
  std::vector<int> map_of_entry;
  for (const FrameRecord& frame : run.frames) map_of_entry.push_back(frame.map_index);
  const auto maps =
      EvaluateEachMap(run.final_trajectory, map_of_entry, TrueTrajectory(sequence), {});
  ASSERT_EQ(maps.size(), 2U);
  for (const MapEvaluation& map : maps) {
    ASSERT_TRUE(map.ate_m);
    EXPECT_LE(map.ate_m->rmse, 0.05) << "map " << map.map_index;
  }
}

TEST(Lost, ShortlyAfterTheStartTheMapIsThrownAway) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomSway, 80, kFrameRateHz);
  // Find the frame that begins the map, then cut the run two frames later.
  const RunRecord whole = RunSynthetic(sequence);
  int begun = 0;
  while (whole.frames[static_cast<std::size_t>(begun)].state != TrackingState::kTracking) ++begun;
  const RunRecord run = RunWithDarkness(sequence, begun + 2, begun + 10);
  EXPECT_EQ(run.counters.at("tracking.maps_reset"), 1);
  EXPECT_EQ(run.counters.at("initializer.maps_begun"), 2);
  EXPECT_EQ(run.num_maps, 1);
  // The poses in the map thrown away are gone with it; the map after it holds the rest.
  EXPECT_EQ(run.final_trajectory[static_cast<std::size_t>(begun)].state, PoseState::kLost);
  EXPECT_EQ(run.online_trajectory[static_cast<std::size_t>(begun)].state, PoseState::kLost);
  EXPECT_EQ(run.frames[static_cast<std::size_t>(begun)].map_index, -1);
  EXPECT_GE(Judge(run, {}).coverage.frames_ok, 50);
}

}  // namespace
}  // namespace lift_slam
