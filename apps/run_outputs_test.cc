#include "apps/run_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/online_trajectory_writer.h"
#include "apps/output_folder.h"
#include "apps/run_report_data.h"
#include "apps/run_result_json.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/fake_run_for_test.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

class RunOutputs : public testing::Test {
 protected:
  RunOutputs() { fs::remove_all(folder_); }
  ~RunOutputs() override { fs::remove_all(folder_); }

  FinishedRun Finish(const FakeRun& fake, const Trajectory& truth) const {
    FinishedRun finished(fake.run, EvaluateRun(fake.run, truth, {}));
    finished.dataset = "kitti";
    finished.sequence = "00";
    finished.configuration = "orb";
    finished.config_yaml = "seed: 3\n";
    finished.ground_truth = truth;
    finished.ground_truth_view = TopView::kXZ;
    finished.provenance.git_revision = "0123abc";
    finished.provenance.peak_memory_bytes = 150'000'000;
    finished.settings = {{"mode", "sequential"}, {"seed", "3"}};
    return finished;
  }
  Json Write(const FinishedRun& finished, RunOutputOptions options = {}) const {
    PrepareOutputFolder(folder_);
    WriteRunOutputs(finished, folder_, options);
    return Json::parse(ReadText(folder_ / "result.json"));
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("lift_slam_outputs_" + std::to_string(getpid()));
};

TEST_F(RunOutputs, GoodRunLeavesEveryFileAndTheFieldsOfTheSpecification) {
  const FakeRun fake = MakeFakeRun({.num_frames = 120});
  const Json json = Write(Finish(fake, fake.truth));
  for (const char* name : {"trajectory.tum", "trajectory_online.tum", "keyframes.tum", "map.ply",
                           "config.yaml", "report.html", "trajectory_aligned.tum"}) {
    EXPECT_GT(fs::file_size(folder_ / name), 0U) << name;
  }
  EXPECT_EQ(json["status"], "OK");
  EXPECT_LT(json["ate"]["rmse"].get<double>(), 1.0);
  EXPECT_NEAR(json["alignment"]["s"].get<double>(), 1.0 / 0.08, 0.2);
  EXPECT_NEAR(json["coverage"]["coverage"].get<double>(), 115.0 / 120.0, 1e-9);
  EXPECT_EQ(json["coverage"]["maps"], 1);
  EXPECT_EQ(json["coverage"]["loops_closed"], 0);
  EXPECT_EQ(json["coverage"]["relocalisations"], 0);
  EXPECT_EQ(json["places"]["loops_closed"], 0);
  EXPECT_TRUE(json["places"]["events"].empty());
  EXPECT_EQ(json["states"]["tracking"], 115);
  EXPECT_EQ(json["refusals"]["low_parallax"], 3);
  EXPECT_EQ(json["refusals"]["pose_rejected"], 0);
  EXPECT_EQ(json["counters"]["culling.points_seldom_found"], 1201);
  EXPECT_GT(json["timing"]["stages"]["extract"]["median_ms"].get<double>(), 1.0);
  EXPECT_EQ(json["timing"]["frame_ms"]["runs"], 120);
  EXPECT_EQ(json["memory"]["peak_bytes"], 150'000'000);
  EXPECT_EQ(json["provenance"]["git_revision"], "0123abc");
  EXPECT_EQ(json["provenance"]["seed"], "3");
  EXPECT_FALSE(json["ate_online"].is_null());
}

TEST_F(RunOutputs, TrajectoryFilesHoldThePosesInMapUnits) {
  const FakeRun fake = MakeFakeRun({.num_frames = 60});
  Write(Finish(fake, fake.truth), {.kitti = true, .euroc = true});
  const Trajectory written = ReadTrajectory(folder_ / "trajectory.tum").trajectory;
  EXPECT_EQ(written.size(), 55U);
  EXPECT_LT((written[3].world_from_cam.translation -
             fake.run.final_trajectory[8].world_from_cam.translation)
                .norm(),
            1e-9);
  EXPECT_EQ(ReadTrajectory(folder_ / "keyframes.tum").trajectory.size(), fake.run.keyframes.size());
  EXPECT_EQ(ReadTrajectory(folder_ / "trajectory.kitti").trajectory[0].frame_index, 5);
  EXPECT_TRUE(fs::exists(folder_ / "trajectory_online.euroc"));
}

TEST_F(RunOutputs, RunThatNeverInitialisedStillLeavesEverything) {
  const FakeRun fake = MakeFakeRun({.num_frames = 60, .num_maps = 0});
  const FinishedRun finished = Finish(fake, fake.truth);
  const Json json = Write(finished);
  EXPECT_EQ(json["status"], "FAIL_INIT");
  EXPECT_TRUE(json["ate"].is_null());
  EXPECT_EQ(json["coverage"]["coverage"], 0.0);
  EXPECT_TRUE(fs::exists(folder_ / "trajectory.tum"));
  const ReportData data = MakeReportData(finished);
  EXPECT_EQ(data.status, ReportStatus::kFailed);
  EXPECT_THAT(data.advice, HasSubstr("The camera has hardly moved"));
  EXPECT_THAT(ReadText(folder_ / "report.html"), HasSubstr("No map was made"));
}

TEST_F(RunOutputs, TruthThatDoesNotOverlapLosesTheErrorsNotTheRun) {
  const FakeRun fake = MakeFakeRun({.num_frames = 60});
  Trajectory truth = fake.truth;
  for (TrajectoryPose& pose : truth) {
    pose.frame_index = -1;
    pose.timestamp_ns += 3'600'000'000'000;
  }
  const Json json = Write(Finish(fake, truth));
  EXPECT_EQ(json["status"], "OK");
  EXPECT_TRUE(json["ate"].is_null());
  EXPECT_FALSE(json["no_errors_reason"].get<std::string>().empty());
}

TEST_F(RunOutputs, WithoutTruthThereIsNoAlignedTrajectoryOfAnEarlierRun) {
  const FakeRun fake = MakeFakeRun({.num_frames = 60});
  Write(Finish(fake, fake.truth));
  EXPECT_TRUE(fs::exists(folder_ / "trajectory_aligned.tum"));
  const Json json = Write(Finish(fake, {}));
  EXPECT_FALSE(fs::exists(folder_ / "trajectory_aligned.tum"));
  EXPECT_EQ(json["status"], "OK");
  EXPECT_TRUE(json["ate"].is_null());
}

TEST_F(RunOutputs, ColmapModelsAreOneAMap) {
  const FakeRun fake = MakeFakeRun({.num_frames = 120, .num_maps = 2});
  FinishedRun finished = Finish(fake, {});
  finished.image_name = [](std::int64_t i) { return "left/" + std::to_string(i) + ".jpg"; };
  Write(finished, {.colmap = true});
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"}) {
    EXPECT_TRUE(fs::exists(folder_ / "colmap" / "0" / name)) << name;
    EXPECT_TRUE(fs::exists(folder_ / "colmap" / "1" / name)) << name;
  }
  EXPECT_THAT(ReadText(folder_ / "colmap" / "0" / "images.txt"), HasSubstr("left/5.jpg"));
}

TEST_F(RunOutputs, InvalidUtf8InNamesDoesNotStopTheWriting) {
  const FakeRun fake = MakeFakeRun({.num_frames = 30});
  FinishedRun finished = Finish(fake, {});
  finished.sequence = "bad\xFFname";
  EXPECT_THAT(Write(finished)["sequence"].get<std::string>(), HasSubstr("bad"));
}

TEST_F(RunOutputs, FileInTheWayOfTheFolderIsAnInputError) {
  fs::create_directories(folder_.parent_path());
  WriteTextAtomically(folder_, "in the way");
  try {
    PrepareOutputFolder(folder_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(folder_.string()));
    EXPECT_THAT(error.what(), HasSubstr("is a file"));
  }
  EXPECT_THROW(PrepareOutputFolder(folder_ / "below"), InputError);
}

TEST_F(RunOutputs, FolderThatCannotBeWrittenIsAnInputError) {
  EXPECT_THROW(PrepareOutputFolder("/proc/lift_slam"), InputError);
  EXPECT_THROW(PrepareOutputFolder("/proc"), InputError);
}

TEST_F(RunOutputs, PreparingLeavesNothingBehind) {
  PrepareOutputFolder(folder_ / "deep" / "er");
  EXPECT_TRUE(fs::is_empty(folder_ / "deep" / "er"));
}

TEST_F(RunOutputs, OnlineTrajectoryCanBeReadWhileTheRunGoesOn) {
  PrepareOutputFolder(folder_);
  const FakeRun fake = MakeFakeRun({.num_frames = 30});
  OnlineTrajectoryWriter writer(folder_ / "trajectory_online.tum");
  std::size_t num_poses = 0;
  for (const TrajectoryPose& pose : fake.run.online_trajectory) {
    writer.Append(pose);
    num_poses += pose.state == PoseState::kOk ? 1 : 0;
    if (num_poses == 0) continue;
    const Trajectory so_far = ReadTrajectory(folder_ / "trajectory_online.tum").trajectory;
    ASSERT_EQ(so_far.size(), num_poses);
    EXPECT_EQ(so_far.back().timestamp_ns, pose.timestamp_ns);
  }
  const std::string text = ReadText(folder_ / "trajectory_online.tum");
  EXPECT_EQ(std::ranges::count(text, '#'), 1);
}

TEST_F(RunOutputs, OnlineTrajectoryOnAFullDiskIsAnInputError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  OnlineTrajectoryWriter writer("/dev/full");
  TrajectoryPose pose;
  EXPECT_THROW(
      {
        for (int i = 0; i < 100; ++i) writer.Append(pose);
      },
      InputError);
}

// For looking at: a report made by the whole chain.
TEST_F(RunOutputs, WritesAPageWhenAFolderIsGiven) {
  const char* folder = std::getenv("LIFT_SLAM_PREVIEW_DIR");
  if (folder == nullptr) GTEST_SKIP() << "set LIFT_SLAM_PREVIEW_DIR to get the page";
  const FakeRun fake = MakeFakeRun({.num_frames = 300});
  WriteRunOutputs(Finish(fake, fake.truth), folder, {});
}

}  // namespace
}  // namespace lift_slam
