#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "apps/program_for_test.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A box of 8 x 8 x 4 m seen from inside, with a chequered texture.
class RenderCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteTexture();
    WriteTextAtomically(folder_ / "room.mtl", "newmtl wall\nKd 1 1 1\nmap_Kd wall.ppm\n");
    WriteTextAtomically(folder_ / "room.obj", RoomObj());
  }

  void WriteTexture() const {
    std::string pixels;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const bool light = ((x * 7 + y * 13) % 64 < 32) != ((x / 4 + y / 8) % 2 == 0);
        pixels += std::string(3, light ? '\xC8' : '\x28');
      }
    }
    WriteTextAtomically(folder_ / "wall.ppm", "P6\n64 64\n255\n" + pixels);
  }

  // y is up.
  static std::string RoomObj() {
    std::string text = "mtllib room.mtl\nusemtl wall\n";
    for (int i = 0; i < 8; ++i) {
      text += "v " + std::string((i & 1) ? "4" : "-4") + " " + ((i & 2) ? "4" : "0") + " " +
              ((i & 4) ? "4" : "-4") + "\n";
    }
    text += "vt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\n";
    for (const char* face : {"1 2 4 3", "5 7 8 6", "1 3 7 5", "2 6 8 4", "1 5 6 2", "3 4 8 7"}) {
      text += "f";
      for (int i = 0; i < 4; ++i) text += std::string(" ") + face[2 * i] + "/" + char('1' + i);
      text += "\n";
    }
    return text;
  }

  Outcome Render(const std::string& arguments) const {
    const std::string size = arguments.find("--size") == std::string::npos ? "--size 160x120 " : "";
    return RunProgram("render " + (folder_ / "room.obj").string() + " --set walk.laps=0.05 " +
                      size + arguments);
  }
  std::string Output() const { return (folder_ / "out").string(); }

  TemporaryFolder folder_;
};

TEST_F(RenderCommand, MakesASequenceThatRunOpens) {
  const Outcome outcome = Render("--output " + Output() + " --pairs --color");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("sequence "));
  EXPECT_TRUE(fs::exists(folder_.path() / "out" / "pairs.txt"));
  EXPECT_THAT(ReadText(folder_.path() / "out" / "render.yaml"), HasSubstr("scene_sha256: "));
  const Outcome same = Render("--output " + Output() + " --pairs --color");
  EXPECT_THAT(same.output, HasSubstr(" 0 of them rendered now"));
  const Outcome other = Render("--output " + Output() + " --pairs --color --seed 7");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.output, HasSubstr("seed = 1, now it is 7"));
}

TEST_F(RenderCommand, RecordRendersTheSameAgain) {
  ASSERT_EQ(Render("--output " + Output()).exit_code, 0);
  const Outcome again = RunProgram("render --config " + Output() + "/render.yaml --output " +
                                   (folder_ / "again").string());
  ASSERT_EQ(again.exit_code, 0) << again.output;
  const std::string image = "sequences/00/image_0/000003.png";
  EXPECT_EQ(ReadText(folder_.path() / "out" / image), ReadText(folder_.path() / "again" / image));
}

TEST_F(RenderCommand, DistortedCameraIsFoundByItsReader) {
  WriteTextAtomically(folder_ / "fisheye.yaml",
                      "{model: kannala_brandt, width: 160, height: 120, fx: 60, fy: 60, cx: 80, "
                      "cy: 60, k1: 0.01, k2: 0, k3: 0, k4: 0}\n");
  const Outcome outcome =
      Render("--camera " + (folder_ / "fisheye.yaml").string() + " --output " + Output());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Outcome run = RunProgram("run " + Output() + "/sequences/00 --frames 0:3 --output " +
                                 (folder_ / "run").string());
  EXPECT_THAT(ReadText(folder_ / "run/log.txt"), HasSubstr("00/camera.yaml")) << run.output;
}

TEST_F(RenderCommand, AnInterruptedRunGoesOn) {
  const std::string arguments =
      "render " + (folder_ / "room.obj").string() + " --size 320x240 " + "--output " + Output();
  BackgroundProgram program(arguments, (folder_ / "log.txt").string());
  const fs::path first = folder_ / "out/sequences/00/image_0/000002.png";
  for (int i = 0; i < 600 && !fs::exists(first) && !program.Ended(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  program.Send(SIGINT);
  EXPECT_EQ(program.Wait(), 130) << ReadText(folder_ / "log.txt");
  EXPECT_THAT(ReadText(folder_ / "log.txt"), HasSubstr("stopped by SIGINT"));
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out")) {
    EXPECT_NE(entry.path().extension(), ".tmp");
  }
}

TEST_F(RenderCommand, RefusesBadInputInOneSentence) {
  const auto why = [&](const std::string& arguments) {
    const Outcome outcome = Render(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    return outcome.output;
  };
  const std::string output = "--output " + Output() + " ";
  EXPECT_THAT(why(""), HasSubstr("--output"));
  EXPECT_THAT(why(output + "--size 0x10"), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_THAT(why(output + "--size 640"), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_THAT(why(output + "--rate 0"), HasSubstr("camera.rate_hz"));
  EXPECT_THAT(why(output + "--laps -1"), HasSubstr("drive.laps"));
  EXPECT_THAT(why(output + "--jobs 0"), HasSubstr("--jobs"));
  EXPECT_THAT(why(output + "--seed -1"), HasSubstr("seed"));
  EXPECT_THAT(why(output + "--set motion=drive"), HasSubstr("no road to drive on"));
  EXPECT_THAT(why(output + "--set walk.height_m=50"), HasSubstr("frame 0 is at"));
  EXPECT_THAT(why(output + "--set sensor.rain=1"), HasSubstr("sensor.rain"));
  EXPECT_THAT(why(output + "--frames 5:1"), HasSubstr("FIRST:LAST:STEP"));
  EXPECT_THAT(why(output + "--size 161x120 --video a.mp4"), HasSubstr("even width"));
  EXPECT_FALSE(fs::exists(Output()));
  EXPECT_THAT(why("--output " + folder_.path().string()), HasSubstr("not empty"));
}

TEST_F(RenderCommand, ShowsHelpAndOptions) {
  EXPECT_THAT(RunProgram("render --help").output, HasSubstr("Examples:"));
  EXPECT_THAT(RunProgram("render --options").output, HasSubstr("lateral_amplitude_m: 0.6"));
}

}  // namespace
}  // namespace lift_slam
