#include "lift_slam/evaluation/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class RunReportTest : public testing::Test {
 protected:
  RunReportTest() { std::filesystem::create_directories(folder_); }
  ~RunReportTest() override { std::filesystem::remove_all(folder_); }

  void WriteRun(const std::string& name, const std::string& sequence, int num_lost,
                double error_m) {
    const Trajectory reference = test::RandomWalk(90, 1);
    Trajectory estimate = reference;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
      estimate[i].world_from_cam.translation.x() += error_m;
      if (static_cast<int>(i) < num_lost) estimate[i].state = PoseState::kNotInitialized;
    }
    EvaluationOptions options;
    options.alignment = AlignmentMode::kNone;
    EvaluationResult result = Evaluate(estimate, reference, options);
    result.dataset = "made";
    result.sequence = sequence;
    WriteText(name, ToJson(result).dump());
  }

  void WriteText(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder_ / name);
    WriteTextAtomically(folder_ / name / "result.json", text);
  }

  RunReport Build() const { return BuildReport(FindResultFiles(folder_)); }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("lift_slam_report_") +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(RunReportTest, MarksFailedPartialAndSkippedRows) {
  WriteRun("a1", "good", 0, 1.0);
  WriteRun("a2", "good", 0, 3.0);
  WriteRun("a3", "good", 81, 50.0);
  WriteRun("b1", "part", 27, 0.5);
  WriteRun("c1", "bad", 90, 0.0);
  WriteText("d1", R"({"dataset": "made", "sequence": "left out", "status": "SKIPPED"})");
  const RunReport report = Build();
  EXPECT_THAT(report.markdown, HasSubstr("| made | good |  | final | cam | none | 2/3 | 70.0 | "
                                         "2.0000 | 2.0000 | 1.0000 | 3.0000 | n/a | n/a | n/a | 0 "
                                         "| 1 failed |"));
  EXPECT_THAT(report.markdown, HasSubstr("| partial (1 of 1) |"));
  EXPECT_THAT(report.markdown, HasSubstr("| made | bad |  | final | cam | none | 0/1 | 0.0 | X |"));
  EXPECT_THAT(report.markdown, HasSubstr("| made | left out |  |  |  |  | 0/0 | - | - |"));
  EXPECT_THAT(report.markdown, HasSubstr("ATE RMSE mean [m]"));
  EXPECT_THAT(report.markdown, HasSubstr("OK: coverage at least 90 %"));
  EXPECT_THAT(report.csv, HasSubstr("made,good,,final,cam,none,,3,2,0,70,2,2,1,3,,,,,"));
  EXPECT_THAT(report.csv, HasSubstr("made,bad,,final,cam,none,X,1,0,0,0,,,,,"));
}

TEST_F(RunReportTest, RunsOfOtherSettingsOrImagesAreNotAveraged) {
  const auto write = [&](const char* name, double error_m, const nlohmann::json& provenance) {
    WriteRun(name, "00", 0, error_m);
    nlohmann::json json = nlohmann::json::parse(ReadText(folder_ / name / "result.json"));
    json["configuration"] = "orb";
    json["provenance"] = provenance;
    WriteText(name, json.dump());
  };
  const std::string one = "1111111122222222", other = "3333333344444444";
  write("a", 1.0, {{"settings_sha256", one}});
  write("b", 3.0, {{"settings_sha256", one}});
  write("c", 5.0, {{"settings_sha256", other}});
  write("d", 7.0, {{"settings_sha256", one}, {"distortion", "gamma=2"}});
  write("e", 9.0, nlohmann::json::object());  // of an earlier version
  const RunReport report = Build();
  const std::string rest = " | final | cam | none | ";
  EXPECT_THAT(report.markdown,
              HasSubstr("| orb, settings 11111111" + rest + "2/2 | 100.0 | 2.0000"));
  EXPECT_THAT(report.markdown,
              HasSubstr("| orb, settings 33333333" + rest + "1/1 | 100.0 | 5.0000"));
  EXPECT_THAT(report.markdown, HasSubstr("| orb, gamma=2" + rest + "1/1 | 100.0 | 7.0000"));
  EXPECT_THAT(report.markdown,
              HasSubstr("| orb, settings unknown" + rest + "1/1 | 100.0 | 9.0000"));
  EXPECT_THAT(report.csv, HasSubstr("made,00,\"orb, settings 33333333\",final,cam,none,"));
}

TEST_F(RunReportTest, EveryCsvRowHasTheColumnsOfTheHeader) {
  WriteRun("a1", "good", 0, 1.0);
  WriteRun("c1", "bad", 90, 0.0);
  std::istringstream lines(Build().csv);
  std::string line;
  std::getline(lines, line);
  const auto num_columns = std::count(line.begin(), line.end(), ',');
  int num_rows = 0;
  for (; std::getline(lines, line); ++num_rows) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), num_columns) << line;
  }
  EXPECT_EQ(num_rows, 2);
}

TEST_F(RunReportTest, BrokenFilesAreNamed) {
  EXPECT_THROW(Build(), InputError);  // no file at all
  WriteText("a", "{ not json");
  EXPECT_THROW(Build(), InputError);
  WriteText("a", R"({"status": "FINE"})");
  EXPECT_THROW(Build(), InputError);
  WriteText("a", R"({"status": "OK", "coverage": {}})");
  try {
    Build();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/coverage/coverage"));
    EXPECT_THAT(error.what(), HasSubstr("result.json"));
  }
  EXPECT_THROW(FindResultFiles("/nonexistent"), InputError);
}

}  // namespace
}  // namespace lift_slam
