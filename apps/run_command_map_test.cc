// `lift_slam run` with maps saved and loaded: outputs, and one sentence for each bad file.
#include <fmt/format.h>

#include <cstdlib>

#include "apps/run_test_fixture.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
constexpr auto kTum = SequenceLayout::kTumRgbd;
constexpr int kFrames = 40;

class RunCommandMap : public RunCommand {
 protected:
  // A map of the first 30 frames.
  fs::path SaveMap() {
    const fs::path map = folder_ / "room.liftmap";
    ExpectAllOutputs(Run(sequence_, "--frames 0:29 --save-map " + map.string()), 0);
    EXPECT_TRUE(fs::is_regular_file(map));
    return map;
  }
  Outcome Load(const fs::path& map, const std::string& arguments = "--localization-only") const {
    return Run(sequence_, "--frames 10:39 --load-map " + map.string() + " " + arguments);
  }

  const fs::path sequence_ = Render(kTum, kFrames);
};

TEST_F(RunCommandMap, LocalizationOnlyGivesPosesInTheLoadedMap) {
  const fs::path map = SaveMap();
  const std::string keyframes = ReadText(output_ / "keyframes.tum");
  EXPECT_NE(keyframes, "");
  const std::string bytes = ReadText(map);
  const auto json = ExpectAllOutputs(Load(map), 0);
  EXPECT_EQ(json["status"], "OK");
  EXPECT_EQ(json["coverage"]["frames_ok"], 30);
  EXPECT_LT(json["ate"]["rmse"], 0.03);
  EXPECT_EQ(json["provenance"]["loaded map"], map.string());
  EXPECT_EQ(json["refusals"]["place_not_recognized"], 0);
  EXPECT_GT(json["map"]["keyframes"], 1);
  EXPECT_EQ(ReadLines(output_ / "keyframes.tum").size(), 1U);  // the title: none of this run
  EXPECT_EQ(ReadText(map), bytes);
}

TEST_F(RunCommandMap, ALoadedMapCanBeSavedAgain) {
  const fs::path map = SaveMap(), grown = folder_ / "grown.liftmap";
  const auto json = ExpectAllOutputs(Load(map, "--save-map " + grown.string()), 0);
  EXPECT_EQ(json["coverage"]["maps"], 1);
  ExpectAllOutputs(Load(grown), 0);
}

TEST_F(RunCommandMap, BadMapFilesAreRefusedByName) {
  const fs::path map = SaveMap();
  const std::string whole = ReadText(map);
  const auto expect = [&](const std::string& contents, const std::string& part) {
    const fs::path bad = folder_ / "bad.liftmap";
    WriteTextAtomically(bad, contents);
    ExpectOneSentence(Load(bad), {bad.string(), part});
  };
  expect("no map", "is no map file of lift_slam");
  expect(whole.substr(0, whole.size() / 2), "truncated");
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  expect(changed, "damaged");
  changed = whole;
  changed[8] = 7;
  expect(changed, "version 7");
  ExpectOneSentence(Load(folder_ / "none"), {(folder_ / "none").string(), "no such file"});
}

TEST_F(RunCommandMap, MapOfOtherFeaturesOrAnotherCameraIsRefused) {
  const fs::path map = SaveMap();
  ExpectOneSentence(Load(map, "--set slam.orb.num_levels=5"), {map.string(), "levels"});
  std::string camera = ReadText(sequence_ / "camera.yaml");
  const auto at = camera.find("375");
  ASSERT_NE(at, std::string::npos);
  WriteTextAtomically(sequence_ / "camera.yaml", camera.replace(at, 3, "380"));
  ExpectOneSentence(Load(map), {map.string(), "another camera"});
}

TEST_F(RunCommandMap, WithoutAVocabularyNoMapIsLoaded) {
  const fs::path map = SaveMap();
  fs::create_directories(folder_ / "none");
  setenv("LIFT_SLAM_VOCABULARY_DIR", (folder_ / "none").c_str(), 1);
  ExpectOneSentence(Load(map), {map.string(), "expected a vocabulary"});
  unsetenv("LIFT_SLAM_VOCABULARY_DIR");
  ExpectOneSentence(Load(map, "--set slam.loop_closing.relocalisation=false"),
                    {"slam.loop_closing.relocalisation"});
}

TEST_F(RunCommandMap, ArgumentsThatContradictOneAnother) {
  ExpectOneSentence(Run(sequence_, "--localization-only"), {"--load-map FILE"});
  ExpectOneSentence(Load(folder_ / "a", "--localization-only --save-map b"), {"--save-map"});
  ExpectOneSentence(Run(sequence_, "--save-map /nowhere/at/all/a"), {"/nowhere/at/all"});
  ExpectOneSentence(Run(sequence_, "--save-map " + folder_.string()), {"is a folder"});
}

// /proc takes no new files, which shows only when the map is written.
TEST_F(RunCommandMap, AMapThatCannotBeSavedLosesNothingElse) {
  const Outcome outcome = Run(sequence_, "--frames 0:29 --save-map /proc/room.liftmap");
  EXPECT_THAT(outcome.output, HasSubstr("/proc/room.liftmap"));
  EXPECT_EQ(ExpectAllOutputs(outcome, 1)["status"], "OK");
}

}  // namespace
}  // namespace lift_slam
