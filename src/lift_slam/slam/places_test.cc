// Loops, lost frames and several maps in whole runs over rendered sequences.
#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"

namespace lift_slam {
namespace {

constexpr double kFrameRateHz = 15.0;
constexpr int kRoundFrames = 300;  // of kRoomLoop, whose round takes 20 s

SyntheticSequenceOptions RoundAndMore(int more_frames) {
  return SmallSequence(SyntheticPath::kRoomLoop, kRoundFrames + more_frames, kFrameRateHz);
}

TestRunOptions WithVocabulary(RunMode mode) {
  TestRunOptions options;
  options.mode = mode;
  options.vocabulary = ShippedOrbVocabulary();
  return options;
}

// Frames from `first` to `last` are black.
std::function<void(InputFrame&)> Darkness(const SyntheticSequenceOptions& sequence, int first,
                                          int last) {
  return [camera = sequence.camera, first, last](InputFrame& frame) {
    if (frame.frame_index >= first && frame.frame_index <= last)
      frame.image = PlainImage(camera, 0);
  };
}

double Ate(const RunRecord& run, const SyntheticSequenceOptions& sequence) {
  const EvaluationResult result = Judge(run, TrueTrajectory(sequence));
  return result.ate_m ? result.ate_m->rmse : 1e9;
}

TEST(Places, ARoundIsClosedAndTheSameInBothModes) {
  const auto sequence = RoundAndMore(30);
  const RunRecord sequential = RunSynthetic(sequence, WithVocabulary(RunMode::kSequential));
  EXPECT_GE(sequential.loops_closed, 1);
  EXPECT_EQ(sequential.num_maps, 1);
  EXPECT_LE(Ate(sequential, sequence), 0.02);
  for (const PlaceEvent& event : sequential.place_events) {
    if (event.rejection != PlaceRejection::kAccepted) continue;
    // The first round, somewhere in view of the same wall.
    EXPECT_GE(event.frame_index - event.other_frame_index, kRoundFrames - 60);
  }
  const RunRecord threaded = RunSynthetic(sequence, WithVocabulary(RunMode::kThreaded));
  EXPECT_TRUE(SamePoses(sequential.final_trajectory, threaded.final_trajectory));
  EXPECT_TRUE(SamePoses(sequential.online_trajectory, threaded.online_trajectory));
}

TEST(Places, NoLoopIsClosedAlongAStreetOfRepeatingHouses) {
  const auto sequence = SmallSequence(SyntheticPath::kStreetDrive, 250, 10.0);
  const RunRecord run = RunSynthetic(sequence, WithVocabulary(RunMode::kThreaded));
  EXPECT_EQ(run.loops_closed, 0);
  EXPECT_EQ(run.maps_merged, 0);
}

// The camera is lost for two seconds and comes back where it was long before.
TEST(Places, AKidnappedCameraIsFoundAgainInTheSameMap) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomLoop, 190, kFrameRateHz);
  const SyntheticSequence images(sequence);
  TestRunOptions options = WithVocabulary(RunMode::kThreaded);
  options.change_frame = [&](InputFrame& frame) {
    if (frame.frame_index >= 130) {
      frame.image = images.Render(static_cast<int>(frame.frame_index) - 90);  // frames 40 to 99
    }
    if (frame.frame_index >= 100 && frame.frame_index < 130) {
      frame.image = PlainImage(sequence.camera, 0);
    }
  };
  const RunRecord run = RunSynthetic(sequence, options);
  EXPECT_EQ(run.lost_events, 1);
  EXPECT_EQ(run.relocalisations, 1);
  EXPECT_EQ(run.num_maps, 1);
  // Within a second, and then for good.
  for (std::size_t i = 130 + 15; i < run.frames.size(); ++i) {
    EXPECT_EQ(run.frames[i].state, TrackingState::kTracking) << i;
  }
  // The same images have the same poses, within 2 % of the way between.
  const auto position = [&](std::size_t i) {
    return run.final_trajectory[i].world_from_cam.translation;
  };
  const double way = (position(99) - position(40)).norm();
  for (std::size_t i = 150; i < 190; ++i) {
    EXPECT_LT((position(i) - position(i - 90)).norm(), 0.02 * way) << i;
  }
}

TEST(Places, SlowInputHasNoGaps) {
  const auto sequence = SmallSequence(SyntheticPath::kRoomLoop, 40, kFrameRateHz);
  TestRunOptions options = WithVocabulary(RunMode::kThreaded);
  options.change_frame = [](InputFrame& frame) { frame.timestamp_ns *= 30; };  // two seconds each
  const RunRecord run = RunSynthetic(sequence, options);
  EXPECT_EQ(run.counters.count("tracking.gaps_in_time"), 0U);
  EXPECT_GE(Judge(run, {}).coverage.frames_ok, 38);
}

TEST(Places, AMapBegunWhenLostJoinsTheFirstWhenItShowsTheSamePlace) {
  const auto sequence = RoundAndMore(60);
  TestRunOptions options = WithVocabulary(RunMode::kThreaded);
  options.change_frame = Darkness(sequence, 100, 139);
  const RunRecord run = RunSynthetic(sequence, options);
  EXPECT_EQ(run.lost_events, 1);
  EXPECT_EQ(run.maps_merged, 1);
  EXPECT_EQ(run.num_maps, 1);
  for (const FrameRecord& frame : run.frames) EXPECT_LE(frame.map_index, 0);
  EXPECT_GE(Judge(run, {}).coverage.frames_ok, 290);
  EXPECT_LE(Ate(run, sequence), 0.15);  // both parts in one frame and scale
}

}  // namespace
}  // namespace lift_slam
