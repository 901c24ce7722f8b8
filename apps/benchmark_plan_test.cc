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
  EXPECT_THAT(tables.output, HasSubstr("ours, ORB features | ? | ? | ? |"));
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

TEST_F(BenchmarkCommand, ASequenceThatTwoFoldersMayBeIsRefused) {
  const fs::path first = Render(SequenceLayout::kKittiOdometry, 4);
  fs::create_directories(folder_ / "data/alpine/sequences");
  fs::copy(first, folder_ / "data/alpine/sequences/00", fs::copy_options::recursive);
  fs::copy(first, folder_ / "data/sequences/03", fs::copy_options::recursive);
  const std::string plan = Arguments("plan kitti", "orb_slam") + " --runs 1";
  ExpectOneSentence(RunProgram(plan), {"data/alpine/sequences/00 and ", "data/sequences/00 may be",
                                       "sequence 00", "narrower folder"});
  EXPECT_EQ(RunProgram(plan + " --sequences 03").exit_code, 0) << "the other is not asked for";
}

TEST_F(BenchmarkCommand, TwoSystemsOfOneTitleAreRefused) {
  Render(SequenceLayout::kKittiOdometry, 12);
  ExpectOneSentence(RunProgram(Arguments("shared", "lift_slam.kitti lift_slam.euroc")),
                    {"lift_slam.euroc.yaml", "have the title 'LIFT-SLAM'", "# title:"});
}

TEST_F(BenchmarkCommand, SequencesOfTheTrainingAreLeftOutWhateverTheyAreCalled) {
  const fs::path first = Render(SequenceLayout::kKittiOdometry, 4), tracks = folder_ / "tracks";
  for (const char* folder : {"real/sequences/00", "rendered/sequences/00", "MH_04_difficult"}) {
    fs::create_directories((tracks / folder).parent_path());
    fs::copy(first, tracks / folder, fs::copy_options::recursive);
  }
  WriteTextAtomically(tracks / "rendered/render.yaml", "# as `lift_slam render` leaves it\n");
  const fs::path system = folder_ / "tuned.yaml";
  WriteTextAtomically(system, "# title: Tuned\n# skip: 00 MH_04\nseed: 0\n");
  const Outcome outcome =
      RunProgram(fmt::format("benchmark plan shared --data {} --output {} --runs 1 --systems {}",
                             tracks.string(), output_.string(), system.string()));
  EXPECT_THAT(outcome.output, HasSubstr("plan        1 runs"));
  const std::string plan = ReadText(output_ / "plan.json");
  EXPECT_THAT(plan, HasSubstr("\"sequence\": \"rendered\""));
  EXPECT_THAT(plan, HasSubstr("\"Tuned|real\""));
  EXPECT_THAT(plan, HasSubstr("\"Tuned|MH_04_difficult\""));
}

TEST_F(BenchmarkCommand, ARebuiltVocabularyAsksForNewRuns) {
  Render(SequenceLayout::kKittiOdometry, 4);
  const fs::path folder = folder_ / "words", file = folder / "orb.vocabulary";
  fs::create_directories(folder);
  const auto plan_with = [&](const char* words, const std::string& arguments) {
    WriteTextAtomically(file, words);
    const Outcome outcome =
        RunProgram(Arguments("plan kitti", "default_orb") + " --runs 1 " + arguments,
                   "LIFT_SLAM_VOCABULARY_DIR=" + folder.string() + " ");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return ReadText(output_ / "plan.json");
  };
  const std::string named = "--set slam.loop_closing.vocabulary=" + file.string();
  const std::string without_loops = "--set slam.loop_closing.enabled=false";
  EXPECT_NE(plan_with("old", ""), plan_with("new", ""));
  EXPECT_NE(plan_with("old", named), plan_with("new", named));
  EXPECT_EQ(plan_with("old", without_loops), plan_with("new", without_loops));
}

TEST_F(BenchmarkCommand, WhatIsAskedForTwiceIsRunOnce) {
  Render(SequenceLayout::kKittiOdometry, 4);
  const Outcome outcome = RunProgram(Arguments("plan kitti", "default_orb default_orb") +
                                     " --runs 1 --conditions none gamma=2 gamma=2.0 none");
  EXPECT_THAT(outcome.output, HasSubstr("plan        2 runs"));
  EXPECT_THAT(RunProgram(Arguments("plan matching", "orb orb")).output,
              HasSubstr("plan        1 runs"));
}

TEST_F(BenchmarkCommand, WeightsOfOneNameAreToldApart) {
  Render(SequenceLayout::kKittiOdometry, 4);
  for (const char* folder : {"a", "b", "other/a"}) {
    fs::create_directories(folder_ / folder);
    WriteTextAtomically(folder_ / folder / "mine.safetensors", folder);
  }
  const std::string plan = Arguments("plan matching", "orb") + " --weights ";
  const std::string a = (folder_ / "a/mine.safetensors").string();
  const std::string b = (folder_ / "b/mine.safetensors").string();
  const Outcome outcome = RunProgram(fmt::format("{}{} {} {}", plan, a, b, a));
  EXPECT_THAT(outcome.output, HasSubstr("plan        3 runs"));
  const std::string text = ReadText(output_ / "plan.json");
  for (const char* title : {"LIFT (a/mine)", "LIFT (b/mine)"}) {
    EXPECT_THAT(text, HasSubstr(fmt::format("\"title\": \"{}\"", title)));
    EXPECT_THAT(text, HasSubstr(fmt::format("\"weights mine.safetensors of {}\": ", title)));
  }
  ExpectOneSentence(RunProgram(plan + a + " " + (folder_ / "other/a/mine.safetensors").string()),
                    {"two files would both be 'LIFT (a/mine)'"});
}

TEST_F(BenchmarkCommand, BadArgumentsAreExplained) {
  fs::create_directories(folder_ / "data");
  ExpectOneSentence(RunProgram(Arguments("kiti")), {"suite 'kiti' is unknown", "robustness"});
  ExpectOneSentence(RunProgram(Arguments("kitti")), {"nothing to run", "sequence 00"});
  ExpectOneSentence(RunProgram(Arguments("matching")), {"'default_orb'", "orb, sift and lift"});
  ExpectOneSentence(RunProgram(Arguments("rendered")), {"lift_slam render makes some"});
  ExpectOneSentence(RunProgram("benchmark kitti --output " + output_.string()), {"--data"});
}

TEST_F(BenchmarkCommand, OptionsThatWouldBeLeftUnreadAreRefused) {
  const std::string output = " --output " + output_.string();
  const auto expect = [&](const std::string& arguments, const std::string& sentence) {
    ExpectOneSentence(RunProgram("benchmark " + arguments + output), {sentence});
  };
  expect("run-job 1 --set slam.features=orb",
         "--set says nothing to 'benchmark run-job 1': it is for a suite and 'plan'");
  expect("plan kitti --data . --feature-cache c", "and 'run-job'");
  expect("plan kitti --data . --jobs 2", "it is for a suite");
  expect("kitti --data . --from b", "it is for 'results'");
  expect("kitti --data . --weights w", "it is for the suite 'matching'");
  expect("merge --runs 3", "--runs says nothing to 'benchmark merge'");
  expect("matching --data . --runs 3", "it is for a suite other than 'matching' and 'plan'");
  expect("kitti euroc --data .", "benchmark kitti: expected nothing after it, found 'euroc'");
  expect("plan --data .", "benchmark plan: expected a suite after it");
  expect("run-job", "benchmark run-job: expected the number of a run after it");
  EXPECT_FALSE(std::filesystem::exists(output_ / "plan.json"));
}

}  // namespace
}  // namespace lift_slam
