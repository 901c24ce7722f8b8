#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/sequence.h"

// Times that cannot be given to images without guessing.
namespace lift_slam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

void WriteTumMono(const TestFolder& folder, const std::string& times) {
  folder.Write("camera.txt", "0.5 0.6 0.5 0.5 0.9\n12 8\n");
  folder.Write("times.txt", times);
}

TEST(ImageFolderTimes, MoreThanImagesAreRefused) {
  const TestFolder folder;
  for (const char* name : {"a1.png", "a2.png", "a4.png"}) folder.WriteImage(name);
  folder.Write("camera.yaml", kTestCamera);
  folder.Write("times.txt", "0.1\n0.2\n0.3\n0.4\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("times.txt has 4 times for 3 images"), HasSubstr("expected one")));
}

TEST(ImageFolderTimes, FewerThanImagesGiveAWarningWithBothCounts) {
  const TestFolder folder;
  for (const char* name : {"a1.png", "a2.png", "a3.png"}) folder.WriteImage(name);
  folder.Write("camera.yaml", kTestCamera);
  folder.Write("times.txt", "0.1\n0.2\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_EQ(sequence->info().num_frames, 2);
  EXPECT_THAT(sequence->info().warnings, ElementsAre(HasSubstr("2 times for 3 images")));
}

TEST(EmptyLine, BetweenTimesIsRefusedWithItsNumber) {
  const TestFolder folder;
  const std::string times = "# seconds\n0.0\n\n0.2\n0.3\n", sentence = "times.txt:3: empty line";
  for (const char* name : {"0.png", "1.png", "2.png"}) {
    folder.WriteImage(std::string("kitti/image_0/") + name);
    folder.WriteImage(std::string("images/") + name);
    folder.WriteImage(std::string("raw/image_00/data/") + name);
  }
  folder.Write("kitti/calib.txt", kKittiCalibration);
  folder.Write("kitti/times.txt", times);
  EXPECT_THAT(OpenError(folder / "kitti"), HasSubstr(sentence));
  folder.Write("images/times.txt", times);
  EXPECT_THAT(OpenError(folder / "images"), HasSubstr(sentence));
  const std::string date = "2011-09-26 13:02:25.964389445\n";
  folder.Write("raw/image_00/timestamps.txt", date + "\n" + date);
  EXPECT_THAT(OpenError(folder / "raw"), HasSubstr("timestamps.txt:2: empty line"));
}

TEST(EmptyLine, AtTheEndIsSkipped) {
  const TestFolder folder;
  for (const char* name : {"0.png", "1.png"}) folder.WriteImage(std::string("image_0/") + name);
  folder.Write("calib.txt", kKittiCalibration);
  folder.Write("times.txt", "0.0\n0.1\n\n \n");
  EXPECT_EQ(ReadAll(*OpenSequence(folder.path().string()))[1].timestamp_ns, 100000000);
}

TEST(TumMonoTimes, TwoImagesOfOneNumberAreRefused) {
  const TestFolder folder;
  folder.WriteImage("images/00001.pgm");
  folder.WriteImage("images/1.pgm");
  WriteTumMono(folder, "1 0.1 1\n");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("images: two images have the number 1"));
}

TEST(TumMonoTimes, TwoTimesOfOneIdAreRefused) {
  const TestFolder folder;
  folder.WriteImage("images/00001.pgm");
  folder.WriteImage("images/00002.pgm");
  WriteTumMono(folder, "00001 0.1 1\n00002 0.2 1\n00001 0.3 1\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("times.txt:3: expected an id that no line"), HasSubstr("00001 0.3")));
}

TEST(EurocTimes, InSecondsAreRefused) {
  const TestFolder folder;
  folder.WriteImage("mav0/cam0/data/1.png");
  folder.Write("mav0/cam0/sensor.yaml", "resolution: [12, 8]\nintrinsics: [10, 11, 5.5, 3.5]\n");
  folder.Write("mav0/cam0/data.csv", "#t,f\n1403636579.050,1.png\n1403636579.100,2.png\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("data.csv:2: expected a whole number in column 1"),
                    HasSubstr("1403636579.050")));
}

TEST(NominalTimes, ThatDoNotFitNameTheImage) {
  const TestFolder folder;
  folder.WriteImage("image_0/1403636579763555584.png");
  folder.WriteImage("image_0/1403636579813555456.png");
  folder.Write("calib.txt", kKittiCalibration);
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("1403636579763555584.png: frame 1403636579763555584 at 10 frames/s"),
                    HasSubstr("a file with their times")));
}

TEST(NominalTimes, TheLargestImageNumberIsNoOverflow) {
  const TestFolder folder;
  folder.WriteImage("image_0/0.png");
  folder.WriteImage("image_0/9223372036854775807.png");
  folder.Write("calib.txt", kKittiCalibration);
  folder.Write("times.txt", "0.5\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_THAT(sequence->info().warnings,
              testing::Contains(HasSubstr("9223372036854775806 images are missing")));
}

TEST(FrameRate, OfTheOptionMustBeUsable) {
  const TestFolder folder;
  folder.WriteImage("1.png");
  folder.Write("camera.yaml", kTestCamera);
  SequenceOptions options;
  for (const double rate_hz : {1e-300, 9e-4, 1.1e5, -1.0, HUGE_VAL, std::nan("")}) {
    options.frame_rate_hz = rate_hz;
    EXPECT_THAT(
        OpenError(folder.path(), options),
        AllOf(HasSubstr("the frame rate is"), HasSubstr("expected 0.001 to 100000 frames/s")));
  }
  options.frame_rate_hz = 1e-3;
  EXPECT_EQ(OpenError(folder.path(), options), "no error");
}

TEST(FrameRate, OfACameraFileMustBeUsable) {
  const TestFolder folder;
  folder.WriteImage("1.png");
  const auto error = [&](const std::string& text) {
    folder.Write("camera.yaml", text);
    return OpenError(folder.path());
  };
  EXPECT_THAT(error(kTestCamera + std::string("frame_rate_hz: 1e-300\n")),
              AllOf(HasSubstr("camera.yaml:8: key 'frame_rate_hz'"), HasSubstr("0.001 to 100000")));
  EXPECT_THAT(error("intrinsics: [10, 11, 5.5, 3.5]\nrate_hz: -20\n"),
              HasSubstr("camera.yaml:2: key 'rate_hz'"));
  EXPECT_THAT(error("Camera.fx: 5\nCamera.fy: 5\nCamera.cx: 5\nCamera.cy: 3\nCamera.fps: 1e9\n"),
              HasSubstr("camera.yaml:5: key 'Camera.fps'"));
  EXPECT_EQ(error(kTestCamera + std::string("frame_rate_hz: 0\n")), "no error");
}

}  // namespace
}  // namespace lift_slam
