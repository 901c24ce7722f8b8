#include "apps/evaluate_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/report_command.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class EvaluateCommand : public testing::Test {
 protected:
  EvaluateCommand() { std::filesystem::create_directories(folder_); }
  ~EvaluateCommand() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  void Write(const std::string& name, const Trajectory& trajectory, TrajectoryFormat format) const {
    WriteTrajectory(trajectory, format, Path(name));
  }

  // What the command prints on standard output.
  std::string Run(std::vector<std::string> arguments) const {
    CLI::App app;
    AddEvaluateCommand(app);
    AddReportCommand(app);
    std::reverse(arguments.begin(), arguments.end());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      app.parse(arguments);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      testing::internal::GetCapturedStderr();
      throw;
    }
    testing::internal::GetCapturedStderr();
    return testing::internal::GetCapturedStdout();
  }

  nlohmann::json Json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "evaluate");
    arguments.push_back("--json");
    return nlohmann::json::parse(Run(std::move(arguments)));
  }

  std::string ErrorOf(const std::vector<std::string>& arguments) const {
    try {
      Run(arguments);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("lift_slam_evaluate_") +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

Trajectory WithoutFrames(const Trajectory& trajectory, int first, int last) {
  Trajectory rest;
  for (const TrajectoryPose& pose : trajectory) {
    if (pose.frame_index < first || pose.frame_index > last) rest.push_back(pose);
  }
  return rest;
}

TEST_F(EvaluateCommand, KittiFilesArePairedByIndexAndOutputIsWritten) {
  const Trajectory reference = test::RandomWalk(300, 1);
  Write("truth.txt", reference, TrajectoryFormat::kKitti);
  Write("estimate.txt", WithoutFrames(reference, 10, 19), TrajectoryFormat::kKitti);
  const nlohmann::json json = Json({"--reference", Path("truth.txt"), "--estimate",
                                    Path("estimate.txt"), "--output", Path("out/deep")});
  EXPECT_EQ(json["association"]["method"], "index");
  EXPECT_LT(json["ate"]["rmse"].get<double>(), 1e-9);
  EXPECT_EQ(json["coverage"]["frames_total"], 300);
  EXPECT_EQ(json["coverage"]["frames_ok"], 290);
  EXPECT_EQ(json["dataset"], "kitti");
  EXPECT_EQ(nlohmann::json::parse(ReadText(Path("out/deep/result.json"))), json);
  EXPECT_EQ(ReadTrajectory(Path("out/deep/aligned.tum")).trajectory.size(), 290U);
  EXPECT_EQ(ReadTrajectory(Path("out/deep/aligned_kitti.txt")).format,
            TrajectoryFormat::kKittiIndexed);
}

TEST_F(EvaluateCommand, TumEstimateAgainstKittiNeedsTheTimes) {
  const Trajectory reference = test::RandomWalk(100, 2);
  Write("truth.txt", reference, TrajectoryFormat::kKitti);
  Write("estimate.tum", WithoutFrames(reference, 0, 4), TrajectoryFormat::kTum);
  std::string times;
  for (int i = 0; i < 100; ++i) times += std::to_string(0.1 * i) + "\n";
  WriteTextAtomically(Path("times.txt"), times);
  const std::vector<std::string> files = {"evaluate", "--reference", Path("truth.txt"),
                                          "--estimate", Path("estimate.tum")};
  EXPECT_THAT(ErrorOf(files), HasSubstr("--times"));
  const nlohmann::json json = Json({"--reference", Path("truth.txt"), "--estimate",
                                    Path("estimate.tum"), "--times", Path("times.txt")});
  EXPECT_EQ(json["association"]["method"], "index");
  EXPECT_LT(json["ate"]["rmse"].get<double>(), 1e-9);
  EXPECT_EQ(json["coverage"]["init_frame"], 5);
  EXPECT_EQ(json["coverage"]["frames_total_source"], "estimate");
}

TEST_F(EvaluateCommand, EurocTruthIsMovedToTheCameraOrKeptInTheBody) {
  const Rigid3d body_from_cam(
      Eigen::Quaterniond(Eigen::AngleAxisd(std::acos(-1.0) / 2.0, Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.3, 0.0, 0.0));
  const Trajectory camera = test::RandomWalk(200, 3);
  Write("truth.csv", CameraFromBodyTrajectory(camera, Inverse(body_from_cam)),
        TrajectoryFormat::kEurocCsv);
  Write("estimate.tum", camera, TrajectoryFormat::kTum);
  WriteTextAtomically(Path("sensor.yaml"),
                      "%YAML:1.0\n# comment\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0.0, -1.0, 0.0, "
                      "0.3,\n    1.0, 0.0, 0.0, 0.0,\n    0.0, 0.0, 1.0, 0.0,\n    0.0, 0.0, 0.0, "
                      "1.0]\n");
  const std::vector<std::string> files = {"--reference", Path("truth.csv"), "--estimate",
                                          Path("estimate.tum")};
  std::vector<std::string> alone = files;
  alone.insert(alone.begin(), "evaluate");
  EXPECT_THAT(ErrorOf(alone), HasSubstr("--sensor-yaml"));
  WriteTextAtomically(Path("bare.yaml"), "rate_hz: 20\n");
  std::vector<std::string> without = alone;
  without.insert(without.end(), {"--sensor-yaml", Path("bare.yaml")});
  EXPECT_THAT(ErrorOf(without), HasSubstr("bare.yaml: no T_BS.data"));
  std::vector<std::string> in_camera = files;
  in_camera.insert(in_camera.end(), {"--sensor-yaml", Path("sensor.yaml")});
  const nlohmann::json camera_json = Json(in_camera);
  EXPECT_LT(camera_json["ate"]["rmse"].get<double>(), 1e-9);
  EXPECT_EQ(camera_json["association"]["max_time_difference_ms"], 10.0);
  std::vector<std::string> in_body = files;
  in_body.insert(in_body.end(), {"--gt-frame", "body"});
  const nlohmann::json body_json = Json(in_body);
  EXPECT_GT(body_json["ate"]["rmse"].get<double>(), 0.05);
  EXPECT_EQ(body_json["gt_frame"], "body");
}

TEST_F(EvaluateCommand, EmptyEstimateIsAFailedRun) {
  Write("truth.txt", test::RandomWalk(50, 4), TrajectoryFormat::kKitti);
  WriteTextAtomically(Path("empty.txt"), "");
  const nlohmann::json json =
      Json({"--reference", Path("truth.txt"), "--estimate", Path("empty.txt")});
  EXPECT_EQ(json["status"], "FAIL_INIT");
  EXPECT_EQ(json["ate"], nullptr);
  EXPECT_THAT(
      ErrorOf({"evaluate", "--reference", Path("empty.txt"), "--estimate", Path("truth.txt")}),
      HasSubstr("holds no pose"));
}

TEST_F(EvaluateCommand, TableAndHelpNameUnitsAndExamples) {
  Write("truth.txt", test::RandomWalk(150, 5), TrajectoryFormat::kKitti);
  const std::string table =
      Run({"evaluate", "--reference", Path("truth.txt"), "--estimate", Path("truth.txt")});
  EXPECT_THAT(table, HasSubstr("t_rel[%]"));
  CLI::App app;
  AddEvaluateCommand(app);
  const std::string help = app.get_subcommand("evaluate")->help();
  EXPECT_THAT(help, HasSubstr("Examples:"));
  EXPECT_THAT(help, HasSubstr("--max-time-difference-ms"));
}

TEST_F(EvaluateCommand, BadArgumentsAreRefused) {
  EXPECT_THROW(Run({"evaluate", "--reference", "a"}), CLI::ParseError);
  EXPECT_THROW(Run({"evaluate", "--reference", "a", "--estimate", "b", "--alignment", "best"}),
               CLI::ParseError);
  EXPECT_THAT(ErrorOf({"evaluate", "--reference", "/nonexistent", "--estimate", "b"}),
              HasSubstr("/nonexistent: no such file"));
}

TEST_F(EvaluateCommand, ReportMergesItsResults) {
  Write("truth.txt", test::RandomWalk(150, 6), TrajectoryFormat::kKitti);
  for (const char* out : {"runs/1", "runs/2"}) {
    Run({"evaluate", "--reference", Path("truth.txt"), "--estimate", Path("truth.txt"),
         "--sequence", "made", "--output", Path(out)});
  }
  const std::string table = Run({"report", Path("runs"), "--output", Path("tables")});
  EXPECT_THAT(table, HasSubstr("| kitti | made |  | final | cam | sim3 | 2/2 | 100.0 |"));
  EXPECT_EQ(ReadText(Path("tables/report.md")), table);
  EXPECT_THAT(ReadText(Path("tables/report.csv")), HasSubstr("kitti,made"));
  EXPECT_EQ(Run({"report", Path("runs"), Path("runs/../runs")}), table) << "each run counts once";
}

}  // namespace
}  // namespace lift_slam
