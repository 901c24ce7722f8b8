// `lift_slam run` on good and bad input: exit code, sentence, files.
#include "apps/run_command.h"

#include <fmt/format.h>

#include <cstdlib>

#include "apps/run_test_fixture.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
constexpr auto kKitti = SequenceLayout::kKittiOdometry;
constexpr auto kTum = SequenceLayout::kTumRgbd;
constexpr int kFrames = 40;

TEST_F(RunCommand, GoodSequenceEndsWithAllOutputs) {
  const Outcome outcome = Run(Render(SequenceLayout::kEuroc, kFrames), "--mode sequential");
  const auto json = ExpectAllOutputs(outcome, 0);
  EXPECT_EQ(json["status"], "OK");
  EXPECT_LT(json["ate"]["rmse"], 0.03);
  EXPECT_EQ(json["coverage"]["maps"], 1);
  EXPECT_EQ(json["interrupted"], false);
  EXPECT_THAT(outcome.output, HasSubstr("report      " + (output_ / "report.html").string()));
}

TEST_F(RunCommand, BothModesAndARepeatedRunGiveTheSameBytes) {
  const fs::path sequence = Render(kTum, kFrames);
  const auto trajectory = [&](const std::string& arguments) {
    ExpectAllOutputs(Run(sequence, arguments), 0);
    return ReadText(output_ / "trajectory.tum");
  };
  const std::string first = trajectory("--mode sequential --seed 3");
  EXPECT_EQ(first, trajectory("--mode sequential --seed 3"));
  EXPECT_EQ(first, trajectory("--mode threaded --seed 3"));
}

TEST_F(RunCommand, RunsOfTheSameSettingsAreToldFromOthers) {
  const fs::path sequence = Render(kTum, 4);
  const auto settings = [&](const std::string& arguments) {
    Run(sequence, arguments);
    const auto json = nlohmann::json::parse(ReadText(output_ / "result.json"));
    return json.at("provenance").at("settings_sha256").get<std::string>();
  };
  const std::string first = settings("");
  EXPECT_EQ(first, settings("--seed 3 --mode sequential --set outputs.kitti=true"));
  EXPECT_NE(first, settings("--frames 0:2:1"));
  EXPECT_NE(first, settings("--set slam.orb.max_features=1500"));
}

// A compressed video of 930 x 282 pixels over the steepest crest of the track, where features are
// few.
TEST_F(RunCommand, TheDemosClipIsNotLostOverItsCrest) {
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "takes minutes in a debug build or under a sanitizer";
#endif
  const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR");
  const fs::path demo = fs::path(source != nullptr ? source : ".") / "demo";
  const auto json = ExpectAllOutputs(
      Run(demo / "dirt-3.mp4",
          fmt::format("--camera {} --frames 250:450:1", (demo / "dirt-3.yaml").string())),
      0);
  EXPECT_EQ(json["coverage"]["coverage"], 1.0);
  EXPECT_EQ(json["coverage"]["maps"], 1);
}

TEST_F(RunCommand, WithoutAVocabularyForTheFeaturesTheRunSaysSoAndGoesOn) {
  fs::create_directories(folder_ / "none");
  setenv("LIFT_SLAM_VOCABULARY_DIR", (folder_ / "none").c_str(), 1);
  const auto json = ExpectAllOutputs(Run(Render(kTum, kFrames)), 0);
  unsetenv("LIFT_SLAM_VOCABULARY_DIR");
  EXPECT_THAT(json["places"]["notice"], HasSubstr("no vocabulary for 'orb' features"));
  EXPECT_THAT(ReadText(output_ / "log.txt"), HasSubstr("loop closing and relocalisation are off"));
}

TEST_F(RunCommand, ShippedVocabularyIsFoundByItself) {
  const auto json = ExpectAllOutputs(Run(Render(kTum, kFrames)), 0);
  EXPECT_EQ(json["places"]["notice"], "");
}

TEST_F(RunCommand, VocabularyThatIsNone) {
  WriteTextAtomically(folder_ / "words", "no vocabulary");
  ExpectOneSentence(Run(Render(kTum, 5), "--vocabulary " + (folder_ / "words").string()),
                    {(folder_ / "words").string()});
}

TEST_F(RunCommand, MissingFolder) {
  ExpectOneSentence(Run("/nowhere/at/all"), {"/nowhere/at/all: no such file or folder"});
  EXPECT_FALSE(fs::exists(output_));
}

TEST_F(RunCommand, FolderWithoutImages) {
  fs::create_directories(folder_ / "empty");
  ExpectOneSentence(Run(folder_ / "empty"), {(folder_ / "empty").string(), "image"});
}

TEST_F(RunCommand, UndecodableAndTruncatedImagesAreSkippedAndCounted) {
  const fs::path sequence = Render(kKitti, kFrames);
  WriteTextAtomically(sequence / "image_0/000025.png", "no image");
  fs::resize_file(sequence / "image_0/000030.png", 5000);
  const Outcome outcome = Run(sequence);
  const auto json = ExpectAllOutputs(outcome, 0);
  EXPECT_EQ(json["refusals"]["image_unreadable"], 2);
  EXPECT_THAT(outcome.output, HasSubstr("000025.png"));
  EXPECT_THAT(outcome.output, HasSubstr("000030.png"));
  EXPECT_EQ(json["coverage"]["frames_ok"], kFrames - 2);
}

TEST_F(RunCommand, ImagesOfAnotherSizeAreSkippedAndCounted) {
  const fs::path sequence = Render(kKitti, kFrames);
  SyntheticSequenceOptions small;
  small.camera.pinhole = {100.0, 100.0, 59.5, 39.5, 120, 80};
  small.num_frames = 1;
  const auto other = WriteSyntheticSequence(folder_ / "small", kKitti, small).folder;
  fs::copy_file(other / "image_0/000000.png", sequence / "image_0/000027.png",
                fs::copy_options::overwrite_existing);
  const Outcome outcome = Run(sequence);
  EXPECT_EQ(ExpectAllOutputs(outcome, 0)["refusals"]["image_size_differs"], 1);
  EXPECT_THAT(outcome.output, HasSubstr("000027.png: is 120x80 pixels, the sequence 480x360"));
}

TEST_F(RunCommand, LiftFeaturesNeedGoodWeights) {
  const fs::path sequence = Render(kKitti, 3);
  setenv("LIFT_SLAM_WEIGHTS", "gone.safetensors", /*overwrite=*/1);
  ExpectOneSentence(Run(sequence, "--features lift"), {"gone.safetensors", "--weights"});
  unsetenv("LIFT_SLAM_WEIGHTS");
  ExpectOneSentence(Run(sequence, "--features lift --weights nowhere.safetensors"),
                    {"nowhere.safetensors"});
  WriteTextAtomically(folder_ / "text.safetensors", "not at all");
  ExpectOneSentence(
      Run(sequence, "--features lift --weights " + (folder_ / "text.safetensors").string()),
      {"text.safetensors"});
  ExpectOneSentence(Run(sequence, "--features surf"), {"surf", "orb", "lift"});
}

TEST_F(RunCommand, FeatureCacheServesTheSecondRunToTheSameBytes) {
  const fs::path sequence = Render(kKitti, 6);
  for (const std::string features :
       {"--features orb", "--features lift --set slam.lift.max_features=200"}) {
    const std::string arguments = features + " --feature-cache " + (folder_ / "cache").string();
    Run(sequence, arguments);
    EXPECT_THAT(ReadText(output_ / "log.txt"), HasSubstr("feature cache: images found 0, made 6"));
    const std::string first = ReadText(output_ / "trajectory_online.tum");
    Run(sequence, arguments);
    EXPECT_THAT(ReadText(output_ / "log.txt"), HasSubstr("feature cache: images found 6, made 0"));
    EXPECT_EQ(first, ReadText(output_ / "trajectory_online.tum"));
  }
}

TEST_F(RunCommand, MissingCalibration) {
  const fs::path sequence = Render(kKitti, 3);
  fs::remove(sequence / "calib.txt");
  ExpectOneSentence(Run(sequence), {"no camera calibration was found", "--camera FILE"});
}

TEST_F(RunCommand, MalformedCalibration) {
  const fs::path sequence = Render(kKitti, 3);
  WriteTextAtomically(sequence / "calib.txt", "P0: 1 2 3\n");
  ExpectOneSentence(Run(sequence), {"calib.txt:1", "12 numbers"});
  WriteTextAtomically(folder_ / "camera.yaml",
                      "model: pinhole\nwidth: many\nheight: 360\nfx: 375\nfy: 375\ncx: 239.5\n"
                      "cy: 179.5\n");
  ExpectOneSentence(Run(sequence, "--camera " + (folder_ / "camera.yaml").string()),
                    {"camera.yaml:2", "width"});
}

TEST_F(RunCommand, FewerTimesThanImages) {
  const fs::path sequence = Render(kKitti, kFrames);
  std::string times;
  for (int i = 0; i < kFrames - 5; ++i) times += std::to_string(i / 15.0) + "\n";
  WriteTextAtomically(sequence / "times.txt", times);
  const Outcome outcome = Run(sequence);
  EXPECT_EQ(ExpectAllOutputs(outcome, 0)["coverage"]["frames_total"], kFrames - 5);
  EXPECT_THAT(outcome.output, HasSubstr("35 times for 40 images"));
}

TEST_F(RunCommand, TimestampsThatDoNotIncrease) {
  const fs::path sequence = Render(kKitti, kFrames);
  std::string times;
  for (int i = 0; i < kFrames; ++i) times += std::to_string((i == 28 ? 3 : i) / 15.0) + "\n";
  WriteTextAtomically(sequence / "times.txt", times);
  const Outcome outcome = Run(sequence);
  EXPECT_EQ(ExpectAllOutputs(outcome, 0)["refusals"]["timestamp_not_increasing"], 1);
  EXPECT_THAT(outcome.output, HasSubstr("1 of 40 images"));
}

TEST_F(RunCommand, GivenTruthOfAnotherTime) {
  const fs::path sequence = Render(kTum, 3);
  const fs::path truth = folder_ / "truth.txt";
  WriteTextAtomically(truth, "1400000000 0 0 0 0 0 0 1\n1400000001 1 0 0 0 0 0 1\n");
  ExpectOneSentence(Run(sequence, "--ground-truth " + truth.string()),
                    {"1400000000.000000000 s to 1400000001.000000000 s", "0.000000000 s to"});
}

TEST_F(RunCommand, TruthInNanosecondsForSecondsIsSuspected) {
  const fs::path sequence = Render(kTum, kFrames);
  std::string images;
  int i = 0;
  const std::vector<fs::path> files = FilesIn(sequence / "rgb");
  for (const fs::path& file : files) {
    images += std::to_string(1400000000.0 + i++ / 15.0) + " rgb/" + file.filename().string() + "\n";
  }
  WriteTextAtomically(sequence / "rgb.txt", images);
  WriteTextAtomically(sequence / "groundtruth.txt", "1.4 0 0 0 0 0 0 1\n1.5 1 0 0 0 0 0 1\n");
  // The sequence's own truth is left out, and the run goes on.
  const Outcome outcome = Run(sequence);
  EXPECT_TRUE(ExpectAllOutputs(outcome, 0)["ate"].is_null());
  for (const char* part : {"1.400000000 s to 1.500000000 s", "1400000000.000000000 s to",
                           "seconds and nanoseconds mixed up?"}) {
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
}

TEST_F(RunCommand, NanInThePoseFile) {
  const fs::path sequence = Render(kTum, 3);
  const fs::path truth = folder_ / "truth.txt";
  WriteTextAtomically(truth, "0 0 0 0 0 0 0 1\n0.1 nan 0 0 0 0 0 1\n");
  ExpectOneSentence(Run(sequence, "--ground-truth " + truth.string()),
                    {"truth.txt:2", "finite number"});
}

TEST_F(RunCommand, UnknownConfigurationKey) {
  const fs::path sequence = Render(kTum, 3);
  ExpectOneSentence(Run(sequence, "--set slam.orb.max_feature=5"),
                    {"max_feature'", "the nearest known is 'slam.orb.max_features'"});
  WriteTextAtomically(folder_ / "my.yaml", "slam:\n  orb:\n    max_feature: 5\n");
  ExpectOneSentence(Run(sequence, "--config " + (folder_ / "my.yaml").string()),
                    {"my.yaml:3", "the nearest known is", "max_features"});
  EXPECT_FALSE(fs::exists(output_));
}

TEST_F(RunCommand, OutputFolderThatCannotBeWritten) {
  const fs::path sequence = Render(kTum, 3);
  WriteTextAtomically(folder_ / "file", "x");
  const auto run = [&](const std::string& output) {
    return RunProgram("run " + sequence.string() + " --output " + output);
  };
  ExpectOneSentence(run((folder_ / "file").string()), {"file: is a file"});
  ExpectOneSentence(run((folder_ / "file/below").string()), {"cannot create the output folder"});
  ExpectOneSentence(run("/proc/lift_slam"), {"/proc/lift_slam: cannot create the output folder"});
  ExpectOneSentence(run("/proc/self"), {"/proc/self: the output folder is not writable"});
}

// A limit on the size of files stands for a full disk: writing beyond it fails in the same way.
TEST_F(RunCommand, DiskFullAtTheEnd) {
  const fs::path sequence = Render(kTum, kFrames);
  const Outcome outcome = RunProgram("run " + sequence.string() + " --output " + output_.string(),
                                     "trap '' XFSZ; ulimit -f 32; ");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("lift_slam: " + output_.string()));
  EXPECT_THAT(outcome.output, HasSubstr("disk full"));
  EXPECT_FALSE(fs::exists(output_ / "result.json"));
}

TEST_F(RunCommand, DiskFullDuringTheRun) {
  const fs::path sequence = Render(kTum, kFrames);
  const Outcome outcome = RunProgram("run " + sequence.string() + " --output " + output_.string(),
                                     "trap '' XFSZ; ulimit -f 1; ");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("trajectory_online.tum: cannot write the file"));
}

TEST_F(RunCommand, OneFrame) {
  const Outcome outcome = Run(Render(kTum, 1));
  const auto json = ExpectAllOutputs(outcome, 3);
  EXPECT_EQ(json["status"], "FAIL_INIT");
  EXPECT_THAT(outcome.output, HasSubstr("only one frame"));
}

// A PGM file; its content, not its name, says what it is.
std::string BlackImageFile(int width, int height) {
  return fmt::format("P5\n{} {}\n255\n{}", width, height,
                     std::string(static_cast<std::size_t>(width * height), '\0'));
}

TEST_F(RunCommand, BlackImages) {
  const fs::path sequence = Render(kKitti, 12);
  for (const auto& entry : fs::directory_iterator(sequence / "image_0")) {
    WriteTextAtomically(entry.path(), BlackImageFile(480, 360));
  }
  const Outcome outcome = Run(sequence);
  const auto json = ExpectAllOutputs(outcome, 3);
  EXPECT_EQ(json["status"], "FAIL_INIT");
  EXPECT_EQ(json["refusals"]["too_few_features"], 12);
  EXPECT_THAT(outcome.output, HasSubstr("too_few_features: Too few features were found"));
}

TEST_F(RunCommand, StillCamera) {
  const Outcome outcome = Run(Render(SequenceLayout::kEuroc, 20, SyntheticPath::kRoomStill));
  const auto json = ExpectAllOutputs(outcome, 3);
  EXPECT_EQ(json["status"], "FAIL_INIT");
  EXPECT_EQ(json["refusals"]["low_parallax"], 19);
  EXPECT_THAT(outcome.output, HasSubstr("19 x low_parallax: The camera has hardly moved"));
}

}  // namespace
}  // namespace lift_slam
