#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lift_slam
