#include "lift_slam/datasets/video_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/videoio.hpp>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/prefetching_sequence.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

constexpr char kVideoCamera[] =
    "{model: pinhole, width: 64, height: 48, fx: 50, fy: 50, cx: 31.5, cy: 23.5}";

// Eight frames at 20 frames/s, frame i of brightness 25 i.
std::filesystem::path WriteVideo(const TestFolder& folder) {
  const std::filesystem::path file = folder / "clip.avi";
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 20.0, {64, 48});
  for (int i = 0; i < 8; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(25 * i)));
  return file;
}

void ExpectBrightness(const SequenceFrame& frame) {
  ASSERT_TRUE(frame.image);
  EXPECT_NEAR(frame.image->row(20)[30], 25.0 * static_cast<double>(frame.frame_index), 4.0);
}

TEST(Video, ReadsEveryFrameAtItsRate) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  folder.Write("clip.yaml", kVideoCamera);
  PrefetchingSequence sequence(OpenSequence(file.string()));
  EXPECT_EQ(sequence.info().format, SequenceFormat::kVideo);
  EXPECT_EQ(sequence.info().name, "clip");
  EXPECT_EQ(sequence.info().num_frames, 8);
  EXPECT_NEAR(sequence.info().camera->frame_rate_hz, 20.0, 1e-6);
  const auto frames = ReadAll(sequence);
  ASSERT_EQ(frames.size(), 8u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame_index, static_cast<std::int64_t>(i));
    ExpectBrightness(frames[i]);
    if (i == 0) continue;
    const std::int64_t step_ns = frames[i].timestamp_ns - frames[i - 1].timestamp_ns;
    EXPECT_NEAR(static_cast<double>(step_ns), 5e7, 2.0);
  }
}

TEST(Video, TakesRangeAndRateFromTheOptions) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  SequenceOptions options;
  options.camera_file = folder.Write("mine.yaml", kVideoCamera);
  options.first = 1;
  options.last = 6;
  options.step = 2;
  options.frame_rate_hz = 10.0;
  const auto sequence = OpenSequence(file.string(), options);
  EXPECT_EQ(sequence->info().num_frames, 3);
  const auto frames = ReadAll(*sequence);
  ASSERT_EQ(frames.size(), 3u);
  for (const SequenceFrame& frame : frames) {
    ExpectBrightness(frame);
    EXPECT_EQ(frame.timestamp_ns, frame.frame_index * 100'000'000);
  }
  EXPECT_EQ(frames.back().frame_index, 5);
  options.first = 20;
  options.last = -1;
  EXPECT_THAT(OpenError(file, options), HasSubstr("selects none of its 8 frames"));
}

TEST(Video, ACutFileGivesTheFramesItHas) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  folder.Write("clip.yaml", kVideoCamera);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const std::string error = InputErrorOf([&] {
    const auto frames = ReadAll(*OpenSequence(file.string()));
    EXPECT_LE(frames.size(), 8u);
  });
  EXPECT_TRUE(error == "no error" || error.find("clip.avi") != std::string::npos) << error;
}

TEST(Video, NeedsACalibrationOfItsSize) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  EXPECT_THAT(OpenError(file), HasSubstr("clip.yaml, camera.yaml beside it"));
  folder.Write("clip.yaml", kTestCamera);
  EXPECT_THAT(OpenError(file), HasSubstr("64x48 pixels, but the calibration"));
}

TEST(Video, PairsATruthByIndex) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  folder.Write("clip.yaml", kVideoCamera);
  SequenceOptions options;
  options.ground_truth_file = folder.Write("poses.txt",
                                           "1 0 0 0 0 1 0 0 0 0 1 0\n"
                                           "1 0 0 1 0 1 0 0 0 0 1 2\n");
  const auto truth = OpenSequence(file.string(), options)->info().ground_truth;
  ASSERT_EQ(truth->poses.size(), 2u);
  EXPECT_EQ(truth->poses[1].timestamp_ns, 50'000'000);
}

}  // namespace
}  // namespace lift_slam
