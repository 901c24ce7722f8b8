#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/image/image.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ExtractCommand : public testing::Test {
 protected:
  void SetUp() override {
    LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
    WriteLiftWeights(weights, folder_ / "w.safetensors");
    Random random(1);
    cv::Mat image(120, 160, CV_8UC1);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x)
        image.at<uchar>(y, x) = static_cast<uchar>(random.Bits());
    }
    cv::imwrite(Path("a.png"), image);
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(ExtractCommand, WritesFeaturesAndAPicture) {
  const Outcome outcome =
      RunProgram("extract " + Path("a.png") + " --upright --max-features 7 --weights " +
                 Path("w.safetensors") + " --output " + Path("out"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("7 features"));
  const std::optional<GrayImage> picture = ReadGrayImage(Path("out/a.png"));
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->width(), 160);
  const std::string npz = ReadText(Path("out/a.npz"));
  EXPECT_THAT(npz, StartsWith("PK\x03\x04"));
  for (const char* part : {"descriptors.npy", "'shape': (7, 128,)", "'descr': '<i4'"}) {
    EXPECT_THAT(npz, HasSubstr(part));
  }
}

TEST_F(ExtractCommand, BadInputIsOneSentence) {
  const std::string files = " --weights " + Path("w.safetensors") + " --output " + Path("out");
  for (const std::string& arguments :
       {Path("a.png") + " --turned" + files, Path("missing.png") + " --upright" + files,
        Path("a.png") + " " + Path("a.png") + " --upright" + files,
        Path("a.png") + " --upright --first-level 30" + files,
        Path("a.png") + " --upright --weights " + Path("none") + " --output " + Path("out")}) {
    const Outcome outcome = RunProgram("extract " + arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: "));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace lift_slam
