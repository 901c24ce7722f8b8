// What a benchmark will run, and what it refuses to.
#include "apps/benchmark_test_fixture.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(BenchmarkCommand, ASuiteTakesOtherSequencesThatAreNamed) {
  Render(SequenceLayout::kKittiOdometry, 12);
  const std::string plan = Arguments("plan robustness", "default_orb") + " --runs 1 --sequences ";
  const Outcome outcome = RunProgram(plan + "00");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("plan        11 runs"));
  ExpectOneSentence(RunProgram(plan + "garage"),
                    {"'garage' is neither in the suite 'robustness' nor below"});
  // Nobody published numbers of this one; what was not run has no coverage either.
  const Outcome tables = RunProgram("benchmark merge --output " + output_.string());
  EXPECT_EQ(tables.exit_code, 0) << tables.output;
  EXPECT_THAT(tables.output, Not(HasSubstr("LIFT-SLAM paper, Table 4")));
  EXPECT_THAT(tables.output, HasSubstr("ours, ORB features | 0/1 | ? | ? |"));
}

TEST_F(BenchmarkCommand, MissingWeightsAreListedWithTheirMaking) {
  Render(SequenceLayout::kKittiOdometry, 4);
  const Outcome outcome =
      RunProgram(Arguments("plan kitti", "default_orb adaptive_tuned_euroc") + " --runs 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("the weights weights/lift-euroc.safetensors are not there "
                                        "(made by lift_slam_train fine-tune"));
  EXPECT_THAT(outcome.output, HasSubstr("plan        1 runs"));
}

TEST_F(BenchmarkCommand, ThresholdsArePlanned) {
  Render(SequenceLayout::kKittiOdometry, 4);
  fs::rename(folder_ / "data/sequences/00", folder_ / "data/sequences/05");
  const Outcome outcome =
      RunProgram(fmt::format("benchmark plan thresholds --data {}/data --output {} --runs 2",
                             folder_.string(), output_.string()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("missing     sequence MH_01"));
  EXPECT_THAT(outcome.output, HasSubstr("plan        8 runs"));
  const std::string plan = ReadText(output_ / "plan.json");
  EXPECT_THAT(plan, HasSubstr("LIFT-SLAM, TH_LOW 1, TH_HIGH 1.5"));
}

TEST_F(BenchmarkCommand, TheShippedAblationChangesOnlySettingsThatExist) {
  Render(SequenceLayout::kKittiOdometry, 4);
  const Outcome outcome =
      RunProgram(fmt::format("benchmark plan ablation --data {}/data --output {} --runs 1",
                             folder_.string(), output_.string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("plan        12 runs"));
  EXPECT_THAT(ReadText(output_ / "plan.json"), HasSubstr("slam.lift.precision=int8"));
}

TEST_F(BenchmarkCommand, SequencesOfOneNameAreToldApart) {
  const fs::path first = Render(SequenceLayout::kKittiOdometry, 4);
  for (const char* track : {"oval", "hills"}) {
    fs::create_directories(folder_ / "tracks" / track / "sequences");
    fs::copy(first, folder_ / "tracks" / track / "sequences/00", fs::copy_options::recursive);
  }
  const Outcome outcome = RunProgram(
      fmt::format("benchmark plan shared --data {}/tracks --output {} --runs 1 --systems orb_slam",
                  folder_.string(), output_.string()));
  EXPECT_THAT(outcome.output, HasSubstr("plan        2 runs"));
  const std::string plan = ReadText(output_ / "plan.json");
  EXPECT_THAT(plan, HasSubstr("\"sequence\": \"oval\""));
  EXPECT_THAT(plan, HasSubstr("\"sequence\": \"hills\""));
}

TEST_F(BenchmarkCommand, TwoSystemsOfOneTitleAreRefused) {
  Render(SequenceLayout::kKittiOdometry, 12);
  ExpectOneSentence(RunProgram(Arguments("shared", "lift_slam.kitti lift_slam.euroc")),
                    {"lift_slam.euroc.yaml", "have the title 'LIFT-SLAM'", "# title:"});
}

TEST_F(BenchmarkCommand, BadArgumentsAreExplained) {
  fs::create_directories(folder_ / "data");
  ExpectOneSentence(RunProgram(Arguments("kiti")), {"suite 'kiti' is unknown", "robustness"});
  ExpectOneSentence(RunProgram(Arguments("kitti")), {"nothing to run", "sequence 00"});
  ExpectOneSentence(RunProgram(Arguments("matching")), {"'default_orb'", "orb, sift and lift"});
  ExpectOneSentence(RunProgram(Arguments("rendered")), {"lift_slam render makes some"});
  ExpectOneSentence(RunProgram("benchmark kitti --output " + output_.string()), {"--data"});
}

}  // namespace
}  // namespace lift_slam
