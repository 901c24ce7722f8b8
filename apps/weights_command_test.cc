#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/testing/texture.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(WeightsCommand, InfoDescribesAFile) {
  const TemporaryFolder files;
  const std::filesystem::path path = files / "weights.safetensors";
  LiftWeights weights = RandomLiftWeights(LiftTopology::kT, 3);
  weights.distances = DistanceQuantiles{{0.1F, 0.2F, 0.3F, 0.4F, 0.5F}, {1, 2, 3, 4, 5}};
  WriteLiftWeights(weights, path);
  const Outcome outcome = RunProgram("weights info " + path.string());
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& part :
       {std::string("random"), weights.sha256, std::string("2019162 parameters"),
        std::string("0.1 0.2 0.3 0.4 0.5"), std::string("He initialisation, seed 3")}) {
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
}

TEST(WeightsCommand, BadInputIsOneSentence) {
  for (const char* arguments :
       {"weights", "weights info", "weights info /nonexistent.safetensors", "weights import a.h5",
        "weights import /nonexistent.h5 --output /tmp/x.safetensors",
        "weights import a.h5 --output b --descriptor G"}) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: ")) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

TEST(WeightsCommand, ImportsWhatTheAuthorsReleased) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const TemporaryFolder files;
  const std::filesystem::path path = files / "weights.safetensors";
  const std::string folder = LiftReferenceFolder().string();
  const Outcome outcome =
      RunProgram("weights import " + folder + "/new-CNN3-picc-iter-56k.h5 " + folder +
                 "/tf-lift-release.h5 --descriptor T --detector noaug --matching 0.3 0.5 0.7 1 1.6 "
                 "--nearest-wrong 1.5 2 2.7 3 3.3 --output " +
                 path.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const Outcome info = RunProgram("weights info " + path.string());
  EXPECT_THAT(info.output, HasSubstr("lift-released-T-kp_noaug"));
  EXPECT_THAT(info.output, HasSubstr("(grey - 110.7539) / 61.5368"));
  EXPECT_THAT(info.output, HasSubstr("none (upright patches)"));
  EXPECT_THAT(info.output, HasSubstr("0.3 0.5 0.7 1 1.6"));
}

class MeasureWeights : public testing::Test {
 protected:
  void SetUp() override {
    LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
    WriteLiftWeights(weights, folder_ / "w.safetensors");
    const Texture texture = MakeTexture(TextureKind::kClutter, 2);
    for (const int shift : {0, 5}) {
      cv::Mat image(240, 320, CV_8UC1);
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          image.at<uchar>(y, x) = cv::saturate_cast<uchar>(
              texture.Sample(static_cast<float>(x + shift), static_cast<float>(y), 0.5F));
        }
      }
      cv::imwrite(Path(fmt::format("{}.png", shift)), image);
    }
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  // Runs on the weights and reads what was written.
  LiftWeights Measure(const std::string& arguments) const {
    const Outcome outcome =
        RunProgram("weights " + arguments + " --weights " + Path("w.safetensors") + " --output " +
                   Path("m.safetensors"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return ReadLiftWeights(folder_ / "m.safetensors");
  }
  TemporaryFolder folder_;
};

TEST_F(MeasureWeights, CalibrateStoresTheRangesThatInt8Needs) {
  const LiftWeights weights = Measure("calibrate --patches 4 --seed 7 " + Path("0.png"));
  ASSERT_EQ(weights.descriptor_ranges.size(), 3U);
  EXPECT_EQ(Measure("calibrate --patches 4 --seed 7 " + Path("0.png")).sha256, weights.sha256);
}

TEST_F(MeasureWeights, DistancesStoresTheQuantiles) {
  const LiftWeights weights =
      Measure("distances --upright --pair " + Path("0.png") + " " + Path("5.png") + " --pair " +
              Path("5.png") + " " + Path("0.png"));
  ASSERT_TRUE(weights.distances.has_value());
  EXPECT_LT(weights.distances->matching[2], weights.distances->nearest_wrong[2]);
}

TEST_F(MeasureWeights, BadInputIsOneSentence) {
  const std::string files = " --weights " + Path("w.safetensors") + " --output " + Path("m");
  cv::imwrite(Path("tiny.png"), cv::Mat(40, 90, CV_8UC1, cv::Scalar(9)));
  cv::imwrite(Path("grey.png"), cv::Mat(90, 90, CV_8UC1, cv::Scalar(9)));
  for (const std::string& arguments :
       {"calibrate" + files, "calibrate " + Path("none.png") + files,
        "calibrate " + Path("tiny.png") + files, "calibrate " + Path("grey.png") + files,
        "calibrate --patches 0 " + Path("0.png") + files, "distances --upright" + files,
        "distances --turned " + Path("0.png") + files,
        "distances --upright " + Path("grey.png") + files,
        "distances --upright --pair " + Path("0.png") + files}) {
    const Outcome outcome = RunProgram("weights " + arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: ")) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace lift_slam
