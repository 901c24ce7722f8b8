// Runs in a map that an earlier run has saved.
#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

constexpr double kFrameRateHz = 15.0;
constexpr int kRoundFrames = 300;  // of kRoomLoop, whose round takes 20 s
constexpr int kMapped = 120;       // frames of the run that saves its map

SyntheticSequenceOptions Room(int num_frames) {
  return SmallSequence(SyntheticPath::kRoomLoop, num_frames, kFrameRateHz);
}

// The first 120 frames of a round through a room, saved; and runs that load them.
class LoadedMap : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    TestRunOptions options;
    options.mode = RunMode::kThreaded;
    options.vocabulary = ShippedOrbVocabulary();
    options.save_maps = MapPath();
    first_ = std::make_unique<RunRecord>(RunSynthetic(Room(kMapped), options));
  }
  static void TearDownTestSuite() {
    first_.reset();
    folder_.reset();
  }

  static std::filesystem::path MapPath() { return *folder_ / "room.liftmap"; }
  static TestRunOptions Loading(bool localization_only) {
    TestRunOptions options;
    options.mode = RunMode::kThreaded;
    options.vocabulary = ShippedOrbVocabulary();
    options.load_maps = MapPath();
    options.slam.localization_only = localization_only;
    return options;
  }
  // Largest distance from where the first run was at the same place of the round, over the way of
  // the first run; and how many were compared.
  struct Offset {
    double largest = 0.0;
    int compared = 0;
  };
  static Offset OffsetFromFirst(const RunRecord& run) {
    const auto& mapped = first_->final_trajectory;
    const double way =
        (mapped[kMapped - 1].world_from_cam.translation - mapped[0].world_from_cam.translation)
            .norm();
    Offset offset;
    for (const TrajectoryPose& pose : run.final_trajectory) {
      const auto same = static_cast<std::size_t>(pose.frame_index % kRoundFrames);
      if (pose.state != PoseState::kOk || same >= mapped.size()) continue;
      if (mapped[same].state != PoseState::kOk) continue;
      const double distance =
          (pose.world_from_cam.translation - mapped[same].world_from_cam.translation).norm();
      offset.largest = std::max(offset.largest, distance / way);
      ++offset.compared;
    }
    return offset;
  }
  static int NewKeyFrames(const RunRecord& run) {
    return static_cast<int>(std::ranges::count_if(
        run.keyframes, [](const KeyFrameRecord& keyframe) { return !keyframe.is_loaded; }));
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::unique_ptr<RunRecord> first_;
};

std::unique_ptr<TemporaryFolder> LoadedMap::folder_;
std::unique_ptr<RunRecord> LoadedMap::first_;

TEST_F(LoadedMap, LocalizationOnlyFindsTheNextRoundWhereTheMapIsAndChangesNothing) {
  // Frames 10 to 99 of the second round: the same places under other noise.
  TestRunOptions options = Loading(/*localization_only=*/true);
  options.first_frame = kRoundFrames + 10;
  const RunRecord run = RunSynthetic(Room(kRoundFrames + 100), options);
  ASSERT_EQ(run.frames.size(), 90U);
  EXPECT_EQ(run.final_trajectory.size(), 90U);  // no frames of the earlier run
  EXPECT_EQ(run.final_trajectory.front().frame_index, kRoundFrames + 10);
  EXPECT_GE(Judge(run, {}).coverage.frames_ok, 85);
  const Offset offset = OffsetFromFirst(run);
  EXPECT_GE(offset.compared, 85);
  EXPECT_LE(offset.largest, 0.02);
  EXPECT_EQ(run.num_maps, 1);
  EXPECT_EQ(NewKeyFrames(run), 0);
  EXPECT_EQ(run.points.size(), first_->points.size());
  EXPECT_EQ(run.keyframes.size(), first_->keyframes.size());
  EXPECT_EQ(run.stage_times_ms.count("final_bundle"), 0U);
}

TEST_F(LoadedMap, LocalizationOnlyElsewhereGivesNoPoseAndTheReason) {
  TestRunOptions options = Loading(/*localization_only=*/true);
  const RunRecord run = RunSynthetic(SmallSequence(SyntheticPath::kStreetDrive, 40, 10.0), options);
  EXPECT_EQ(CountOf(run, FrameRefusal::kPlaceNotRecognized), 40);
  EXPECT_EQ(run.num_maps, 1);
  EXPECT_EQ(NewKeyFrames(run), 0);
  for (const FrameRecord& frame : run.frames) {
    EXPECT_EQ(frame.state, TrackingState::kLost);
    EXPECT_FALSE(frame.world_from_cam.has_value());
  }
}

TEST_F(LoadedMap, LocalizationOnlyIsLostBeyondTheMapAndFindsItselfAgain) {
  TestRunOptions options = Loading(/*localization_only=*/true);
  options.first_frame = kRoundFrames - 60;
  const RunRecord run = RunSynthetic(Room(kRoundFrames + 60), options);
  EXPECT_GT(CountOf(run, FrameRefusal::kPlaceNotRecognized), 10);
  EXPECT_EQ(run.num_maps, 1);
  for (std::size_t i = 80; i < run.frames.size(); ++i) {
    EXPECT_EQ(run.frames[i].state, TrackingState::kTracking) << i;
  }
  EXPECT_LE(OffsetFromFirst(run).largest, 0.02);
}

TEST_F(LoadedMap, ARunGoesOnInTheLoadedMap) {
  TestRunOptions options = Loading(/*localization_only=*/false);
  options.first_frame = 60;
  options.save_maps = *folder_ / "grown.liftmap";
  const RunRecord run = RunSynthetic(Room(180), options);
  EXPECT_EQ(run.num_maps, 1);
  EXPECT_GE(Judge(run, {}).coverage.frames_ok, 115);
  EXPECT_GE(NewKeyFrames(run), 3);
  EXPECT_LE(OffsetFromFirst(run).largest, 0.03);
  // Mapped beyond the first run, in its scale.
  const EvaluationResult result = Judge(run, TrueTrajectory(Room(180)));
  ASSERT_TRUE(result.ate_m.has_value());
  EXPECT_LE(result.ate_m->rmse, 0.03);
  EXPECT_GT(std::filesystem::file_size(options.save_maps), std::filesystem::file_size(MapPath()));
}

TEST_F(LoadedMap, AMapBegunElsewhereJoinsTheLoadedOne) {
  TestRunOptions options = Loading(/*localization_only=*/false);
  options.first_frame = 200;
  const RunRecord run = RunSynthetic(Room(kRoundFrames + 70), options);
  EXPECT_EQ(run.maps_merged + run.relocalisations, 1);
  EXPECT_EQ(run.num_maps, 1);
  EXPECT_LE(OffsetFromFirst(run).largest, 0.1);
}

TEST_F(LoadedMap, LocalizationIsTheSameInBothModes) {
  TestRunOptions options = Loading(/*localization_only=*/true);
  options.first_frame = 30;
  const RunRecord threaded = RunSynthetic(Room(60), options);
  options.mode = RunMode::kSequential;
  const RunRecord sequential = RunSynthetic(Room(60), options);
  EXPECT_TRUE(SamePoses(threaded.final_trajectory, sequential.final_trajectory));
  EXPECT_EQ(Judge(threaded, {}).coverage.frames_ok, 30);
}

}  // namespace
}  // namespace lift_slam
