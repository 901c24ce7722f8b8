#include "lift_slam/datasets/video_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/videoio.hpp>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/prefetching_sequence.h"
#include "lift_slam/util/file.h"

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

// Images after one another without any container, as cameras stream them.
std::filesystem::path WriteStream(const TestFolder& folder, int num_frames) {
  std::string stream;
  for (int i = 0; i < num_frames; ++i) {
    std::vector<unsigned char> jpeg;
    cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(25 * i)), jpeg);
    stream.append(jpeg.begin(), jpeg.end());
  }
  folder.Write("clip.yaml", kVideoCamera);
  return folder.Write("clip.mjpeg", stream);
}

std::string KittiPoses(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("1 0 0 {} 0 1 0 0 0 0 1 0\n", i);
  return text;
}

TEST(Video, OfUnknownLengthKeepsTheWholeTruth) {
  const TestFolder folder;
  const auto file = WriteStream(folder, 6);
  SequenceOptions options;
  options.frame_rate_hz = 10.0;
  options.ground_truth_file = folder.Write("kitti.txt", KittiPoses(6));
  auto sequence = OpenSequence(file.string(), options);
  ASSERT_FALSE(sequence->info().num_frames);
  EXPECT_EQ(sequence->info().ground_truth->poses.size(), 6u);
  EXPECT_EQ(sequence->info().ground_truth->poses.at(5).timestamp_ns, 500'000'000);
  EXPECT_THAT(sequence->info().warnings, testing::IsEmpty());
  EXPECT_EQ(ReadAll(*sequence).size(), 6u);

  options.ground_truth_file = folder.Write("tum.txt", "0.2 0 0 0 0 0 0 1\n0.3 1 0 0 0 0 0 1\n");
  sequence = OpenSequence(file.string(), options);
  EXPECT_EQ(sequence->info().ground_truth->poses.size(), 2u);
}

// Sets the 32-bit number `offset` bytes after a mark in the file.
void Patch(const std::filesystem::path& file, const char* mark, std::size_t offset,
           std::uint32_t value) {
  std::string data = ReadText(file);
  const std::size_t position = data.find(mark);
  ASSERT_NE(position, std::string::npos);
  for (std::size_t i = 0; i < 4; ++i) {
    data[position + offset + i] = static_cast<char>(value >> (8 * i) & 0xFF);
  }
  std::ofstream(file, std::ios::binary) << data;
}

TEST(Video, AnAbsurdLengthTakesNoMemory) {
  const TestFolder folder;
  const auto file = WriteVideo(folder);
  folder.Write("clip.yaml", kVideoCamera);
  constexpr std::uint32_t kClaimed = 999'000'000;
  Patch(file, "avih", 8 + 16, kClaimed);
  Patch(file, "strh", 8 + 32, kClaimed);
  SequenceOptions options;
  options.ground_truth_file = folder.Write("poses.txt", KittiPoses(3));
  const auto sequence = OpenSequence(file.string(), options);
  EXPECT_EQ(sequence->info().num_frames, kClaimed);
  EXPECT_EQ(sequence->info().ground_truth->poses.size(), 3u);
  EXPECT_EQ(ReadAll(*sequence).size(), 8u);
}

}  // namespace
}  // namespace lift_slam
