#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/testing/texture.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class BenchmarkFeatures : public testing::Test {
 protected:
  void SetUp() override {
    const Texture texture = MakeTexture(TextureKind::kClutter, 2);
    for (const float shift : {0.0F, 6.0F}) {
      cv::Mat image(200, 260, CV_8UC1);
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          image.at<uchar>(y, x) = cv::saturate_cast<uchar>(
              texture.Sample(static_cast<float>(x) + shift, static_cast<float>(y), 1.0F));
        }
      }
      cv::imwrite(Path(shift > 0.0F ? "b.png" : "a.png"), image);
    }
    LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
    WriteLiftWeights(weights, folder_ / "random.safetensors");
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  Outcome Run(const std::string& arguments) const {
    return RunProgram("benchmark-features --data " + Path("no_data") + " --max-features 60 " +
                      arguments);
  }
  std::string Pair() const { return "--pair " + Path("a.png") + " " + Path("b.png") + " "; }

  TemporaryFolder folder_;
};

TEST_F(BenchmarkFeatures, TablesAndPlotOfAPairAreWritten) {
  const Outcome outcome = Run(Pair() + "--weights " + Path("random.safetensors") +
                              " --tables matching homography --output " + Path("out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string tables = ReadText(folder_ / "out/features.md");
  for (const char* part : {"| ORB |", "| SIFT |", "| random upright ", "γ 0.25", "3 px"}) {
    EXPECT_THAT(tables, HasSubstr(part));
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
  EXPECT_THAT(ReadText(folder_ / "out/matching_accuracy.svg"), HasSubstr("ORB"));
}

TEST_F(BenchmarkFeatures, BadInputIsOneSentence) {
  const std::string weights = "--weights " + Path("random.safetensors") + " ";
  for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
           {weights, "no images"},
           {Pair() + "--weights " + Path("none"), "none"},
           {weights + "--pair " + Path("a.png") + " " + Path("c.png"), "c.png"},
           {weights + Pair() + "--tables beauty", "beauty"},
           {weights + Pair() + "--pairs 0", "--pairs"}}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
}

}  // namespace
}  // namespace lift_slam
