#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/sequence.h"

// What bad sequences lead to: one sentence, or a frame without image and its reason.
namespace lift_slam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// Five KITTI images with times and calibration.
void WriteKitti(const TestFolder& folder) {
  std::string times;
  for (int i = 0; i < 5; ++i) {
    folder.WriteImage(fmt::format("image_0/{:06}.png", i), i);
    times += fmt::format("0.{}\n", i);
  }
  folder.Write("times.txt", times);
  folder.Write("calib.txt", kKittiCalibration);
}

std::vector<ImageProblem> Problems(const std::vector<SequenceFrame>& frames) {
  std::vector<ImageProblem> problems;
  for (const SequenceFrame& frame : frames) {
    EXPECT_EQ(frame.image.has_value(), frame.problem == ImageProblem::kNone);
    EXPECT_EQ(frame.problem_text.empty(), frame.problem == ImageProblem::kNone);
    problems.push_back(frame.problem);
  }
  return problems;
}

constexpr ImageProblem kNone = ImageProblem::kNone;

TEST(BadSource, MissingFolderIsNamed) {
  EXPECT_EQ(OpenError("/nowhere/at/all"), "/nowhere/at/all: no such file or folder");
}

TEST(BadSource, PathsTheSystemRefusesAreInputErrors) {
  EXPECT_THAT(OpenError(std::string(5000, 'x')), HasSubstr("too long"));
}

TEST(BadSource, UnknownLayoutSaysWhatWasLookedFor) {
  const TestFolder folder;
  folder.Write("notes.txt", "x");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("no sequence of a known layout"), HasSubstr("no mav0/cam0"),
                    HasSubstr("no rgb.txt"), HasSubstr("no image_00/data"), HasSubstr(".png")));
}

TEST(BadSource, ArchivesAndSingleImagesComeWithAdvice) {
  const TestFolder folder;
  EXPECT_THAT(OpenError(folder.Write("a.zip", "PK")), HasSubstr("unpack it"));
  EXPECT_THAT(OpenError(folder.WriteImage("a.png")), HasSubstr("give the folder"));
  folder.Write("mono/images.zip", "PK");
  folder.Write("mono/times.txt", "0 1 1\n");
  folder.Write("mono/camera.txt", "0.5 0.6 0.5 0.5 0.9\n12 8\n");
  EXPECT_THAT(OpenError(folder / "mono"),
              AllOf(HasSubstr("images.zip"), HasSubstr("unpack it into the folder images")));
}

TEST(BadSource, AFileThatIsNoVideoIsRefused) {
  const TestFolder folder;
  EXPECT_THAT(OpenError(folder.Write("a.mp4", "this is no video")),
              HasSubstr("cannot be opened as a video"));
}

TEST(BadSource, AbsentLiveCamerasAreRefused) {
  SequenceOptions options;
  EXPECT_EQ(OpenError("97"), "the camera 97 cannot be opened");
  EXPECT_THAT(OpenError("http://127.0.0.1:9/stream.mjpg"), HasSubstr("cannot be opened"));
}

TEST(BadSource, AForcedFormatNamesTheFileItMisses) {
  const TestFolder folder;
  folder.WriteImage("a.png");
  SequenceOptions options;
  options.format = SequenceFormat::kTumRgbd;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("rgb.txt: no such file"));
  options.format = SequenceFormat::kKittiOdometry;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("no image folder image_0"));
  options.format = SequenceFormat::kEuroc;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("cam0"));
  EXPECT_THAT(OpenError(folder / "a.png", options), HasSubstr("is no folder"));
}

TEST(BadSource, AnEmptyImageFolderIsNamed) {
  const TestFolder folder;
  std::filesystem::create_directories(folder / "image_0");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("image_0: there is no image in it"));
}

TEST(BadSource, ACameraThatIsNotThereIsNamed) {
  const TestFolder folder;
  WriteKitti(folder);
  SequenceOptions options;
  options.camera_name = "image_3";
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("no camera 'image_3'"));
}

TEST(BadSource, UnknownFormatNameListsTheKnown) {
  EXPECT_THAT(InputErrorOf([] { ParseFormatName("kiti"); }),
              AllOf(HasSubstr("'kiti'"), HasSubstr("kitti, kitti_raw, euroc")));
  EXPECT_EQ(ParseFormatName("tum_mono"), SequenceFormat::kTumMono);
  EXPECT_EQ(FormatName(SequenceFormat::kLiveCamera), "live");
}

TEST(BadRange, IsExplained) {
  const TestFolder folder;
  WriteKitti(folder);
  SequenceOptions options;
  options.step = 0;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("STEP >= 1"));
  options.step = 1;
  options.first = 7;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("none of its frames 0 to 4"));
  options.last = 3;
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("7:3:1 is not valid"));
}

TEST(BadImages, AnUndecodableOneInTheMiddleIsAFrameWithItsReason) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("image_0/000001.png", "no image");
  std::filesystem::resize_file(folder / "image_0/000003.png", 60);
  const auto frames = ReadAll(*OpenSequence(folder.path().string()));
  EXPECT_THAT(Problems(frames), ElementsAre(kNone, ImageProblem::kUnreadable, kNone,
                                            ImageProblem::kUnreadable, kNone));
  EXPECT_THAT(frames[1].problem_text, HasSubstr("000001.png"));
  EXPECT_EQ(frames[1].timestamp_ns, 100000000);
}

TEST(BadImages, AListedImageThatIsAbsentIsAFrameWithItsReason) {
  const TestFolder folder;
  folder.WriteImage("rgb/1.png");
  folder.Write("rgb.txt", "1 rgb/1.png\n2 rgb/2.png\n");
  folder.Write("camera.yaml", kTestCamera);
  const auto frames = ReadAll(*OpenSequence(folder.path().string()));
  EXPECT_THAT(Problems(frames), ElementsAre(kNone, ImageProblem::kUnreadable));
  EXPECT_THAT(frames[1].problem_text, HasSubstr("2.png: no such file"));
}

TEST(BadImages, TheFirstOneMayBeUnreadable) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("image_0/000000.png", "no image");
  EXPECT_EQ(Problems(ReadAll(*OpenSequence(folder.path().string()))).front(),
            ImageProblem::kUnreadable);
}

TEST(BadImages, NoneReadableIsAnError) {
  const TestFolder folder;
  folder.Write("1.png", "no image");
  folder.Write("2.png", "no image");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("none of the 2 images can be read"), HasSubstr("1.png")));
}

TEST(BadImages, OneOfAnotherSizeIsAFrameWithItsReason) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.WriteImage("image_0/000002.png", 0, 14, 8);
  const auto frames = ReadAll(*OpenSequence(folder.path().string()));
  EXPECT_THAT(Problems(frames),
              ElementsAre(kNone, kNone, ImageProblem::kSizeDiffers, kNone, kNone));
  EXPECT_THAT(frames[2].problem_text, HasSubstr("is 14x8 pixels, the sequence 12x8"));
}

TEST(BadImages, OneFrameOpensWithAWarning) {
  const TestFolder folder;
  folder.WriteImage("1.png");
  folder.Write("camera.yaml", std::string(kTestCamera) + "frame_rate_hz: 10\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_EQ(sequence->info().num_frames, 1);
  EXPECT_THAT(sequence->info().warnings, ElementsAre(HasSubstr("only one frame")));
  EXPECT_EQ(ReadAll(*sequence).size(), 1u);
}

TEST(BadImages, TwoOfOneNumberAreRefused) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.WriteImage("image_0/000003.jpg");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("two images have the number 3"));
}

TEST(BadCalibration, MissingSaysWhereItWasLookedForAndHowToGiveOne) {
  const TestFolder folder;
  WriteKitti(folder);
  std::filesystem::remove(folder / "calib.txt");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("no camera calibration was found"), HasSubstr("calib.txt (line P0:)"),
                    HasSubstr("--camera FILE"), HasSubstr("{model: pinhole, width: 640")));
  SequenceOptions options;
  options.calibration = CalibrationNeed::kOptional;
  EXPECT_FALSE(OpenSequence(folder.path().string(), options)->info().camera);
}

TEST(BadCalibration, MalformedNamesFileAndLine) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("calib.txt", "P0: 1 2 3\n");
  EXPECT_THAT(OpenError(folder.path()), AllOf(HasSubstr("calib.txt:1"), HasSubstr("12 numbers")));
  folder.Write("calib.txt", "P1: 10 0 5.5 0 0 10 3.5 0 0 0 1 0\n");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("there is no line 'P0:'"));
  SequenceOptions options;
  options.camera_file = "/nowhere.yaml";
  EXPECT_EQ(OpenError(folder.path(), options), "/nowhere.yaml: no such camera file");
}

TEST(BadCalibration, OfAnotherImageSizeIsOneClearError) {
  const TestFolder folder;
  folder.WriteImage("1.png", 0, 14, 8);
  folder.Write("camera.yaml", kTestCamera);
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("1.png: is 14x8 pixels"), HasSubstr("camera.yaml is for 12x8")));
}

TEST(BadCalibration, PrincipalPointOutsideTheImagesIsRefused) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("calib.txt", "P0: 10 0 500 0 0 10 3.5 0 0 0 1 0\n");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("outside the image of 12x8"));
}

TEST(BadCalibration, MountingThatIsNotRigidIsRefused) {
  const TestFolder folder;
  folder.WriteImage("mav0/cam0/data/1.png");
  folder.Write("mav0/cam0/data.csv", "1,1.png\n");
  folder.Write("mav0/cam0/sensor.yaml",
               "T_BS:\n  data: [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"
               "resolution: [12, 8]\nintrinsics: [10, 11, 5.5, 3.5]\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("sensor.yaml:2: key 'T_BS/data'"), HasSubstr("rigid transform")));
}

TEST(BadTimes, FewerThanImagesGiveAWarningWithBothCounts) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("times.txt", "0.0\n0.1\n0.2\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_EQ(sequence->info().num_frames, 3);
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(AllOf(HasSubstr("3 times for 5 images"), HasSubstr("the 2 images"))));
  EXPECT_EQ(ReadAll(*sequence).size(), 3u);
}

TEST(BadTimes, MissingAreNominalWithAWarning) {
  const TestFolder folder;
  WriteKitti(folder);
  std::filesystem::remove(folder / "times.txt");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(AllOf(HasSubstr("times.txt is missing"), HasSubstr("10 frames/s"))));
  EXPECT_EQ(ReadAll(*sequence)[4].timestamp_ns, 400000000);
}

TEST(BadTimes, MalformedNameFileAndLine) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("times.txt", "0.0\n#\nabc\n0.2\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("times.txt:3: expected a time"), HasSubstr("'abc'")));
  folder.Write("times.txt", "");
  EXPECT_THAT(OpenError(folder.path()), HasSubstr("has 0 times"));
}

TEST(BadTimes, FramesOutOfOrderAreSkippedWithTheirReason) {
  const TestFolder folder;
  WriteKitti(folder);
  folder.Write("times.txt", "0.0\n0.2\n0.1\n0.3\n0.3\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(AllOf(HasSubstr("2 of 5 images are skipped"), HasSubstr("000002.png"))));
  const auto frames = ReadAll(*sequence);
  EXPECT_THAT(Problems(frames), ElementsAre(kNone, kNone, ImageProblem::kTimestampNotIncreasing,
                                            kNone, ImageProblem::kTimestampNotIncreasing));
  EXPECT_THAT(frames[2].problem_text, HasSubstr("100000000 ns does not increase"));
}

TEST(BadTimes, MalformedIndexFilesNameTheLine) {
  const TestFolder folder;
  folder.WriteImage("tum/rgb/1.png");
  folder.Write("tum/rgb.txt", "# c\n1 rgb/1.png\n2\n");
  EXPECT_THAT(OpenError(folder / "tum"), HasSubstr("rgb.txt:3: expected a time in seconds and"));
  folder.WriteImage("asl/mav0/cam0/data/1.png");
  folder.Write("asl/mav0/cam0/data.csv", "#t,f\nx,1.png\n");
  EXPECT_THAT(OpenError(folder / "asl"), HasSubstr("data.csv:2: expected a whole number"));
  folder.WriteImage("raw/image_00/data/0.png");
  folder.Write("raw/image_00/timestamps.txt", "26.09.2011\n");
  EXPECT_THAT(OpenError(folder / "raw"), HasSubstr("timestamps.txt:1: expected a date and time"));
}

TEST(BadTruth, NanNamesFileAndLine) {
  const TestFolder folder;
  folder.WriteImage("rgb/1.png");
  folder.Write("rgb.txt", "1 rgb/1.png\n");
  folder.Write("camera.yaml", kTestCamera);
  folder.Write("groundtruth.txt", "# c\n1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n");
  EXPECT_THAT(OpenError(folder.path()),
              AllOf(HasSubstr("groundtruth.txt:3"),
                    HasSubstr("column 2 is nan, expected a finite number")));
}

TEST(BadTruth, WithoutOverlapIsNotUsedAndSaysBothRanges) {
  const TestFolder folder;
  folder.WriteImage("rgb/1.png");
  folder.WriteImage("rgb/2.png");
  folder.Write("rgb.txt", "1400000000.5 rgb/1.png\n1400000001.5 rgb/2.png\n");
  folder.Write("camera.yaml", kTestCamera);
  folder.Write("groundtruth.txt", "1.4 0 0 0 0 0 0 1\n1.5 0 0 0 0 0 0 1\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_FALSE(sequence->info().ground_truth);
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(AllOf(HasSubstr("1.400000000 s to 1.500000000 s"),
                                HasSubstr("1400000000.500000000 s to 1400000001.500000000 s"),
                                HasSubstr("seconds and nanoseconds mixed up?"))));
  SequenceOptions options;
  options.ground_truth_file = folder / "groundtruth.txt";
  EXPECT_THAT(OpenError(folder.path(), options), HasSubstr("shares no time with the images"));
}

TEST(BadTruth, GivenFileMustHoldPoses) {
  const TestFolder folder;
  WriteKitti(folder);
  const auto error = [&](const std::string& text) {
    SequenceOptions options;
    options.ground_truth_file = folder.Write("truth.txt", text);
    return OpenError(folder.path(), options);
  };
  EXPECT_THAT(error("# nothing\n"), HasSubstr("truth.txt: the file holds no pose"));
  EXPECT_THAT(error("1 2 3\n"), HasSubstr("truth.txt:1: 3 columns, expected 8 (TUM"));
  EXPECT_THAT(error("1 0 0 0 0 0 0.2 1\n"), HasSubstr("truth.txt:1: the quaternion has norm"));
  EXPECT_THAT(error("1400000000.5,1,2,3,1,0,0,0\n"), HasSubstr("truth.txt:1: timestamp"));
}

TEST(BadTruth, TimesInNanosecondsAreNoticed) {
  const TestFolder folder;
  folder.WriteImage("rgb/1.png");
  folder.Write("rgb.txt", "1400000000.5 rgb/1.png\n");
  folder.Write("camera.yaml", kTestCamera);
  folder.Write("groundtruth.txt", "1400000000500000000 0 0 0 0 0 0 1\n");
  const auto sequence = OpenSequence(folder.path().string());
  ASSERT_TRUE(sequence->info().ground_truth);
  EXPECT_EQ(sequence->info().ground_truth->poses.at(0).timestamp_ns, 1400000000500000000);
  EXPECT_THAT(sequence->info().warnings, testing::Contains(HasSubstr("taken for nanoseconds")));
}

TEST(BadTruth, GivenFileMustExist) {
  const TestFolder folder;
  WriteKitti(folder);
  SequenceOptions options;
  options.ground_truth_file = "/nowhere.txt";
  EXPECT_EQ(OpenError(folder.path(), options), "/nowhere.txt: no such file");
}

}  // namespace
}  // namespace lift_slam
