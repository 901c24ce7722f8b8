#include "lift_slam/simulation/sequence_video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SequenceVideo : public ::testing::Test {
 protected:
  // Grey images that become brighter.
  std::vector<fs::path> Images(int count, int width) const {
    std::vector<fs::path> files;
    for (int i = 0; i < count; ++i) {
      files.push_back(folder_ / (std::to_string(i) + ".png"));
      cv::imwrite(files.back().string(), cv::Mat(48, width, CV_8UC1, cv::Scalar(5.0 * i)));
    }
    return files;
  }

  TemporaryFolder folder_;
};

TEST_F(SequenceVideo, IsReadBackWithItsFramesTimesAndCamera) {
  const fs::path video = folder_ / "drive.mp4";
  ASSERT_TRUE(WriteVideo(video, Images(30, 64), 10.0, {}));
  WriteTextAtomically(folder_ / "drive.yaml",
                      "{model: pinhole, width: 64, height: 48, fx: 50, fy: 50, cx: 32, cy: 24}\n");
  const auto sequence = OpenSequence(video.string(), {});
  EXPECT_EQ(sequence->info().num_frames, 30);
  for (int i = 0; i < 30; ++i) {
    const auto frame = sequence->Next();
    ASSERT_TRUE(frame && frame->image) << i;
    EXPECT_EQ(frame->timestamp_ns, i * 100000000LL);
    EXPECT_NEAR(frame->image->row(24)[32], 5.0 * i, 4.0);
  }
  EXPECT_FALSE(sequence->Next());
}

TEST_F(SequenceVideo, RefusesOddSidesAndUnknownKinds) {
  try {
    WriteVideo(folder_ / "odd.mp4", Images(3, 65), 10.0, {});
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("even width and height, the images are 65x48"));
  }
  EXPECT_THROW(WriteVideo(folder_ / "missing/a.mp4", Images(3, 64), 10.0, {}), InputError);
  EXPECT_THROW(WriteVideo(folder_ / "a.nothing", Images(3, 64), 10.0, {}), InputError);
}

TEST_F(SequenceVideo, LeavesNoFileWhenStopped) {
  const std::vector<fs::path> images = Images(5, 64);
  EXPECT_FALSE(WriteVideo(folder_ / "stopped.mp4", images, 10.0, [] { return true; }));
  EXPECT_FALSE(fs::exists(folder_ / "stopped.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "stopped.part.mp4"));
}

}  // namespace
}  // namespace lift_slam
