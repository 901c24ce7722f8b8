#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "apps/benchmark_test_fixture.h"
#include "lift_slam/testing/real_data.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/visualization/xml_check_for_test.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(BenchmarkCommand, RunsKittiAndListsWhatIsMissing) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const Outcome outcome = RunProgram(Arguments("kitti") + " --runs 1 --jobs 2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("missing     sequence 01 is not below"));
  EXPECT_THAT(outcome.output, HasSubstr("2 done now, 0 were done, 0 failed"));
  const std::string table = ReadText(output_ / "tables.md");
  EXPECT_THAT(table, HasSubstr("r_rel [deg/100 m]"));
  EXPECT_THAT(table, HasSubstr("**"));     // the best
  EXPECT_THAT(table, HasSubstr("11.54"));  // of the paper
  EXPECT_THAT(table, HasSubstr("| 00* |"));
  EXPECT_THAT(table, HasSubstr("*: of 00 only 40 of 4541 frames were run"));
  EXPECT_THAT(ReadText(output_ / "tables.tex"), HasSubstr("Algorithm & Metric & 00* & 01"));
  const std::string page = ReadText(output_ / "tables.html");
  EXPECT_TRUE(fs::is_regular_file(output_ / "figures/trajectory_00.svg"));
  if (fs::is_regular_file("/usr/bin/rsvg-convert")) {
    EXPECT_THAT(ReadText(output_ / "figures/trajectory_00.pdf"), testing::StartsWith("%PDF"));
  }
  EXPECT_THAT(page, HasSubstr("ground truth"));
  EXPECT_EQ(XmlProblem(page, /*html=*/true), "");
  for (const char* name : {"tables.csv", "tables.tex", "tables.html"}) {
    EXPECT_TRUE(fs::is_regular_file(output_ / name)) << name;
  }
  const Outcome again = RunProgram(Arguments("kitti") + " --runs 1", "PATH=/none ");
  EXPECT_THAT(again.output, HasSubstr("0 done now, 2 were done, 0 failed"));
  EXPECT_THAT(again.output, HasSubstr("figures as SVG alone: rsvg-convert is not there"));
  EXPECT_FALSE(fs::exists(output_ / "figures/trajectory_00.pdf"));
  EXPECT_TRUE(fs::is_regular_file(output_ / "figures/trajectory_00.svg"));
}

TEST_F(BenchmarkCommand, RunsEurocJobByJob) {
  const fs::path written = Render(SequenceLayout::kEuroc, 40);
  fs::create_directories(folder_ / "moved");
  fs::rename(written, folder_ / "moved" / "MH_02_easy");
  fs::remove_all(folder_ / "data");
  fs::rename(folder_ / "moved", folder_ / "data");
  ASSERT_EQ(RunProgram(Arguments("plan euroc") + " --runs 1").exit_code, 0);
  EXPECT_TRUE(Finished().empty());
  for (const char* job : {"1", "2"}) {
    const Outcome outcome =
        RunProgram(fmt::format("benchmark run-job {} --output {}", job, output_.string()));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  EXPECT_EQ(Finished().size(), 2U);
  const Outcome merged = RunProgram("benchmark merge --output " + output_.string());
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  EXPECT_THAT(merged.output, HasSubstr("MH_02"));
  fs::create_directories(folder_ / "other");
  fs::copy_file(output_ / "results" / *Finished().begin() / "trajectory.tum",
                folder_ / "other/MH_02_easy.txt");
  const Outcome joined = RunProgram(fmt::format("benchmark merge --output {} --external Other={}",
                                                output_.string(), (folder_ / "other").string()));
  EXPECT_THAT(joined.output, HasSubstr("MH_02, Other | 1/1 | 100.0 | 0.0"));
  EXPECT_THAT(joined.output, testing::Not(HasSubstr("t_rel [%]")));
  ExpectOneSentence(RunProgram("benchmark run-job 3 --output " + output_.string()),
                    {"a number from 1 to 2"});
}

TEST_F(BenchmarkCommand, ARunThatBreaksIsReportedByTheExitCode) {
  const fs::path sequence = Render(SequenceLayout::kKittiOdometry, 12);
  fs::remove(sequence / "calib.txt");
  const std::string arguments = Arguments("kitti", "default_orb") + " --runs 1";
  const Outcome outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("0 done now, 0 were done, 1 failed"));
  EXPECT_THAT(ReadText(output_ / "tables.md"), HasSubstr("| ours, ORB features | ? |"));
  EXPECT_EQ(RunProgram("benchmark run-job 1 --output " + output_.string()).exit_code, 1);
}

TEST_F(BenchmarkCommand, GoesOnAfterAKillAndRepeatsNothing) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const std::string arguments = Arguments("kitti") + " --runs 3";
  {
    BackgroundProgram program(arguments, folder_ / "printed.txt");
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (Finished().empty() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    program.Send(SIGKILL);
    EXPECT_EQ(program.Wait(), -SIGKILL);
  }
  const std::set<std::string> before = Finished();
  ASSERT_FALSE(before.empty());
  ASSERT_LT(before.size(), 6U);
  std::map<std::string, fs::file_time_type> times;
  for (const std::string& name : before) {
    times[name] = fs::last_write_time(output_ / "results" / name / "result.json");
  }
  const Outcome outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(fmt::format("{} done now, {} were done, 0 failed",
                                                    6 - before.size(), before.size())));
  EXPECT_EQ(Finished().size(), 6U);
  EXPECT_TRUE(FilesIn(output_ / "running").empty()) << "left by the one that was killed";
  for (const auto& [name, time] : times) {
    EXPECT_EQ(fs::last_write_time(output_ / "results" / name / "result.json"), time);
  }
}

TEST_F(BenchmarkCommand, ConditionsBecomeRowsAndAChart) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const Outcome outcome = RunProgram(Arguments("robustness", "default_orb") +
                                     " --runs 1 --conditions none salt-pepper=0.05");
  ExpectOneSentence(outcome, {"nothing to run", "sequence 03"});
  fs::rename(folder_ / "data/sequences/00", folder_ / "data/sequences/06");
  fs::rename(folder_ / "data/poses/00.txt", folder_ / "data/poses/06.txt");
  const Outcome found = RunProgram(Arguments("robustness", "default_orb") +
                                   " --runs 1 --conditions none salt-pepper=0.05");
  ASSERT_EQ(found.exit_code, 0) << found.output;
  EXPECT_THAT(found.output, HasSubstr("2 done now, 0 were done, 0 failed"));
  EXPECT_THAT(found.output, HasSubstr("| 06* salt-pepper=0.05 | **"));
  EXPECT_THAT(found.output,
              HasSubstr("| ours, ORB features | ORB-SLAM [LIFT-SLAM paper, Table 4]"));
  EXPECT_THAT(ReadText(output_ / "figures/ate_06.svg"), HasSubstr(">salt-pepper=0.05<"));
}

TEST_F(BenchmarkCommand, TrajectoriesOfOthersJoin) {
  Render(SequenceLayout::kKittiOdometry, 40);
  ASSERT_EQ(RunProgram(Arguments("kitti", "default_orb") + " --runs 1").exit_code, 0);
  fs::create_directories(folder_ / "perfect");
  fs::copy_file(folder_ / "data/poses/00.txt", folder_ / "perfect/00.txt");
  fs::create_directories(folder_ / "part");  // by time, of the first three quarters
  const std::vector<std::string> lines =
      ReadLines(output_ / "results" / *Finished().begin() / "trajectory_aligned.tum");
  std::string part;
  for (std::size_t i = 0; i < 31; ++i) part += lines[i] + "\n";
  WriteTextAtomically(folder_ / "part/00.tum", part);
  const std::string merge = "benchmark merge --output " + output_.string();
  const Outcome outcome = RunProgram(fmt::format(
      "{0} --external Perfect={1}/perfect --external Part={1}/part", merge, folder_.string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("| Perfect | **0.000** | ? |"));
  EXPECT_THAT(outcome.output, HasSubstr("(75 %) |"));
  EXPECT_THAT(ReadText(output_ / "figures/trajectory_00.svg"), HasSubstr(">Perfect<"));

  ExpectOneSentence(RunProgram(merge + " --external Perfect"), {"expected NAME=FOLDER"});
  ExpectOneSentence(RunProgram(merge + " --external P=" + (folder_ / "data").string()),
                    {"no trajectory of a sequence", "00.txt"});
  WriteTextAtomically(folder_ / "perfect/00.txt", "1 2 3\n");
  ExpectOneSentence(RunProgram(fmt::format("{} --external P={}/perfect", merge, folder_.string())),
                    {"00.txt"});
}

TEST_F(BenchmarkCommand, ThresholdsThatVaryAreDrawn) {
  Render(SequenceLayout::kKittiOdometry, 40);
  ASSERT_EQ(RunProgram(Arguments("kitti", "default_orb") + " --runs 1").exit_code, 0);
  WriteTextAtomically(output_ / "results" / *Finished().begin() / "frames.csv",
                      "frame,low_threshold,high_threshold\n0,0,0\n1,50,100\n2,55,110\n");
  ASSERT_EQ(RunProgram("benchmark merge --output " + output_.string()).exit_code, 0);
  const std::string svg = ReadText(output_ / "figures/thresholds_00_ours_ORB_features.svg");
  EXPECT_THAT(svg, HasSubstr(">high (guided)<"));
  EXPECT_EQ(XmlProblem(svg), "");
}

TEST_F(BenchmarkCommand, VariantsAreComparedOnWhateverIsThere) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const fs::path variants = folder_ / "variants.yaml";
  WriteTextAtomically(variants,
                      "base: default_orb\nvariants:\n- {name: default, title: as it is}\n"
                      "- {name: few, title: 600 features, set: [slam.orb.max_features=600]}\n");
  const std::string ablation = fmt::format("benchmark ablation --data {}/data --output {} --runs 2",
                                           folder_.string(), output_.string());
  const Outcome outcome = RunProgram(ablation + " --variants " + variants.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("4 done now, 0 were done, 0 failed"));
  for (const char* title : {"ATE RMSE, median of the runs [m] | 00", "least to largest [m] | 00",
                            "| Coverage, mean [%] | 00", "| Time of a frame, median"}) {
    EXPECT_THAT(outcome.output, HasSubstr(title));
  }
  EXPECT_THAT(outcome.output, HasSubstr("| 600 features | 100.0 |"));
  EXPECT_THAT(ReadText(output_ / "tables.csv"), HasSubstr("\"600 features\",\"00\",frame_ms,2,2,"));
  EXPECT_THAT(ReadText(output_ / "figures/ate_00.svg"), HasSubstr(">600 features<"));

  for (const std::string& name : Finished()) {
    WriteTextAtomically(output_ / "results" / name / "log.txt",
                        "0 warning: LIFT's descriptors in bfloat16: int8 needs ranges\n");
  }
  EXPECT_THAT(RunProgram("benchmark merge --output " + output_.string()).output,
              HasSubstr("\n600 features: LIFT's descriptors in bfloat16: int8 needs ranges.\n"));

  ExpectOneSentence(RunProgram(ablation + " --systems fewer --variants " + variants.string()),
                    {"variant 'fewer' is unknown", "'few'"});
  WriteTextAtomically(variants, "base: default_orb\nvariants:\n- {name: default}\n");
  ExpectOneSentence(RunProgram(ablation + " --variants " + variants.string()),
                    {"variants.yaml", "name, title and set"});
}

TEST_F(BenchmarkCommand, SecondRunFindsFeaturesInTheCacheAndGivesNoTimes) {
  Render(SequenceLayout::kKittiOdometry, 12);
  const Outcome outcome = RunProgram(
      fmt::format("benchmark shared --data {0}/data --output {1} --systems adaptive --runs 2 --set "
                  "slam.lift.max_features=200 --feature-cache {0}/cache",
                  folder_.string(), output_.string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  int found = 0, made = 0;
  for (const std::string& name : Finished()) {
    const std::string log = ReadText(output_ / "results" / name / "log.txt");
    found += log.find("images found 12, made 0") != std::string::npos ? 1 : 0;
    made += log.find("images found 0, made 12") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(found, 1);
  EXPECT_EQ(made, 1);
  // Of the run that made them.
  EXPECT_THAT(ReadText(output_ / "tables.csv"), HasSubstr("\"00\",frame_ms,2,1,"));
}

TEST_F(BenchmarkCommand, MatchingIsCountedOverPairsAndGoesOn) {
  Render(SequenceLayout::kKittiOdometry, 14);
  const std::string matching = Arguments("matching", "orb sift") + " --pairs 3";
  const Outcome planned = RunProgram("benchmark plan " + matching.substr(10));
  EXPECT_THAT(planned.output, HasSubstr("plan        2 runs"));
  ASSERT_EQ(RunProgram("benchmark run-job 1 --output " + output_.string()).exit_code, 0);
  const Outcome outcome = RunProgram(matching);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("1 done now, 1 were done, 0 failed"));
  EXPECT_THAT(outcome.output, HasSubstr("| 00: inliers, mean of the pairs | t+1 | t+2 |"));
  const std::string csv = ReadText(output_ / "tables.csv");
  EXPECT_THAT(csv, HasSubstr("matching,\"ORB\",\"00\",t+10,3,"));
  EXPECT_THAT(csv, HasSubstr("matching,\"SIFT\",\"00\",gamma=0.25,3,"));
  for (const char* name : {"skip_00.svg", "gamma_00.svg"}) {
    EXPECT_EQ(XmlProblem(ReadText(output_ / "figures" / name)), "") << name;
  }
  ExpectOneSentence(RunProgram(matching + " --set slam.seed=1"), {"--set"});
}

TEST_F(BenchmarkCommand, ResultsBecomeADocumentThatTheSameResultsGiveAgain) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const std::string options = " --runs 1 --set slam.loop_closing.enabled=false --frames 0:38:1";
  ASSERT_EQ(RunProgram(Arguments("kitti", "default_orb") + options).exit_code, 0);
  const fs::path matching = folder_ / "matching", document = folder_ / "docs/results.md";
  ASSERT_EQ(RunProgram(fmt::format("benchmark matching --data {}/data --systems orb --pairs 2 "
                                   "--output {}",
                                   folder_.string(), matching.string()))
                .exit_code,
            0);
  fs::create_directories(folder_ / "docs/results");
  for (const char* name : {"kitti_trajectory_07.svg", "drawn_by_hand.svg"}) {
    WriteTextAtomically(folder_ / "docs/results" / name, "<svg/>");
  }
  const std::string results = fmt::format("benchmark results --from {} {} --output {}",
                                          output_.string(), matching.string(), document.string());
  const Outcome outcome = RunProgram(results);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string text = ReadText(document);
  for (const char* part :
       {"## kitti\n", "## matching\n", "| finished | 1 of 1 jobs |", "| SHA-256, sequence 00 | `",
        "| set for every system | `slam.loop_closing.enabled=false` |", "| frames | 0:38:1 |",
        "| images, sequence 00 | 39 |", "| SHA-256, settings of ours, ORB features, seed 0 | `",
        "| processor | ", "![00](results/kitti_trajectory_00.svg)",
        "![00](results/matching_skip_00.svg)"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_FALSE(fs::exists(folder_ / "docs/results/kitti_trajectory_07.svg"));
  EXPECT_TRUE(fs::exists(folder_ / "docs/results/drawn_by_hand.svg"));
  EXPECT_TRUE(fs::is_regular_file(folder_ / "docs/results/kitti_trajectory_00.svg"));
  ASSERT_EQ(RunProgram(results).exit_code, 0);
  EXPECT_EQ(ReadText(document), text);

  // Two of one suite are told apart by their folders.
  const fs::path other = folder_ / "narrow";
  fs::copy(output_, other, fs::copy_options::recursive);
  const fs::path both = folder_ / "both.md";
  ASSERT_EQ(RunProgram(fmt::format("benchmark results --from {} {} --output {}", output_.string(),
                                   other.string(), both.string()))
                .exit_code,
            0);
  EXPECT_THAT(ReadText(both), AllOf(HasSubstr("## kitti_" + output_.filename().string() + "\n"),
                                    HasSubstr("## kitti_narrow\n"), Not(HasSubstr("## kitti\n"))));

  ExpectOneSentence(RunProgram("benchmark results --output " + document.string()), {"--from"});
  ExpectOneSentence(
      RunProgram(fmt::format("benchmark results --from {0} --output {0}", output_.string())),
      {"must end in .md"});
  fs::remove_all(output_ / "results");
  ExpectOneSentence(RunProgram(results), {"has no finished run"});
  EXPECT_TRUE(fs::is_regular_file(folder_ / "docs/results/kitti_trajectory_00.svg"))
      << "the document from before is still whole";
}

// Inliers of the mean under a condition, of features on the only sequence of a table.
double InliersIn(const std::string& csv, const std::string& features,
                 const std::string& condition) {
  const std::size_t row = csv.find("matching,\"" + features + "\",\"06\"," + condition + ",");
  if (row == std::string::npos) return -1.0;
  std::istringstream rest(csv.substr(row));
  std::string field;
  for (int i = 0; i < 8; ++i) std::getline(rest, field, ',');
  return ParseDouble(field).value_or(-1.0);
}

TEST_F(BenchmarkCommand, LiftMatchesDarkRealImagesBetterThanOrb) {
  if (RealDataFolder().empty()) GTEST_SKIP() << "no real data: set LIFT_SLAM_DATA";
  const fs::path kitti = RealDataFolder() / "kitti";
  if (!fs::is_directory(kitti / "sequences/06")) GTEST_SKIP() << "no KITTI 06 in " << kitti;
  const Outcome outcome = RunProgram(
      fmt::format("benchmark matching --data {} --sequences 06 --systems orb lift --pairs 2 "
                  "--output {}",
                  kitti.string(), output_.string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string csv = ReadText(output_ / "tables.csv");
  for (const char* condition : {"t+5", "gamma=0.25", "gamma=4"}) {
    EXPECT_GT(InliersIn(csv, "LIFT", condition), 1.3 * InliersIn(csv, "ORB", condition))
        << condition;
    EXPECT_GT(InliersIn(csv, "ORB", condition), 8.0) << condition;
  }
}

TEST_F(BenchmarkCommand, PairsNeedElevenFrames) {
  const fs::path sequence = Render(SequenceLayout::kKittiOdometry, 10);
  ExpectOneSentence(RunProgram(fmt::format("match-sequence {} --features orb --output {}",
                                           sequence.string(), output_.string())),
                    {"has 10 frames", "need 11"});
}

}  // namespace
}  // namespace lift_slam
