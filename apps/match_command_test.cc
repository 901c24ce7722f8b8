#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
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
using testing::StartsWith;

// a.png and b.png show one picture, b by the homography `b_from_a_`.
class MatchCommand : public testing::Test {
 protected:
  void SetUp() override {
    const Texture texture = MakeTexture(TextureKind::kClutter, 2);
    cv::Mat a(240, 320, CV_8UC1), b;
    for (int y = 0; y < a.rows; ++y) {
      for (int x = 0; x < a.cols; ++x) {
        a.at<uchar>(y, x) = cv::saturate_cast<uchar>(
            texture.Sample(static_cast<float>(x), static_cast<float>(y), 1.0F));
      }
    }
    cv::warpPerspective(a, b, b_from_a_, a.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
    cv::imwrite(Path("a.png"), a);
    cv::imwrite(Path("b.png"), b);
    cv::imwrite(Path("tiny.png"), a(cv::Rect(0, 0, 40, 50)));
    LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
    WriteLiftWeights(weights, folder_ / "w.safetensors");
    WriteTextAtomically(folder_ / "camera.yaml",
                        "{model: pinhole, width: 320, height: 240, fx: 300, fy: 300, cx: 160, "
                        "cy: 120}\n");
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::string Images() const { return Path("a.png") + " " + Path("b.png") + " "; }

  // Of the best matches, the part whose places fit the homography within 3 pixels.
  double RightShare(const nlohmann::json& json) const {
    int num_right = 0;
    for (const nlohmann::json& match : json["best"]) {
      const cv::Vec3d there = b_from_a_ * cv::Vec3d(match["x_a"], match["y_a"], 1.0);
      const double dx = there[0] / there[2] - match["x_b"].get<double>();
      const double dy = there[1] / there[2] - match["y_b"].get<double>();
      num_right += std::hypot(dx, dy) < 3.0 ? 1 : 0;
    }
    return static_cast<double>(num_right) / static_cast<double>(json["best"].size());
  }

  TemporaryFolder folder_;
  const cv::Matx33d b_from_a_{1.03, 0.02, -6.0, -0.015, 0.99, 4.0, 4e-5, -2e-5, 1.0};
};

TEST_F(MatchCommand, MatchesFitTheHomography) {
  for (const std::string features : {"orb", "sift"}) {
    const Outcome outcome =
        RunProgram("match " + Images() + "--features " + features +
                   " --max-features 300 --best 60 --gamma 0.8 --camera " + Path("camera.yaml") +
                   " --output " + Path("m.png") + " --json " + Path("m.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("inliers (essential matrix); of the best 60"));
    const auto json = nlohmann::json::parse(ReadText(Path("m.json")));
    EXPECT_EQ(json["best"].size(), 60U);
    EXPECT_EQ(json["gamma"], 0.8);
    EXPECT_GT(RightShare(json), 0.85) << features;
    EXPECT_GE(json["best_inliers"], 50) << features;
    EXPECT_GE(json["inliers"], json["best_inliers"]);
    const cv::Mat picture = cv::imread(Path("m.png"));
    EXPECT_GE(picture.cols, 640);
    EXPECT_GE(picture.rows, 240);
  }
}

// The detector of random weights repeats in the same image alone.
TEST_F(MatchCommand, LiftMatchesAnImageWithItself) {
  const Outcome outcome = RunProgram(
      "match " + Path("a.png") + " " + Path("a.png") + " --upright --max-features 80 --weights " +
      Path("w.safetensors") + " --output " + Path("m.png") + " --json " + Path("m.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("LIFT (random, upright, "));
  const auto json = nlohmann::json::parse(ReadText(Path("m.json")));
  EXPECT_THAT(json["descriptors"].get<std::string>(), StartsWith("lift:"));
  EXPECT_EQ(json["inliers"], json["matches"]);
  ASSERT_GE(json["best"].size(), 70U);
  for (const nlohmann::json& match : json["best"]) {
    EXPECT_EQ(match["x_a"], match["x_b"]);
    EXPECT_EQ(match["y_a"], match["y_b"]);
    EXPECT_LT(match["distance"], 1e-3);
  }
}

TEST_F(MatchCommand, SameInputGivesTheSameFiles) {
  for (const char* name : {"1", "2"}) {
    RunProgram("match " + Images() + "--features orb --output " + Path("x.png") + " --json " +
               Path(name));
  }
  EXPECT_EQ(ReadText(Path("1")), ReadText(Path("2")));
  EXPECT_THAT(ReadText(Path("1")), HasSubstr("\"model\": \"fundamental\""));
}

TEST_F(MatchCommand, ImageWithoutFeaturesHasNoMatches) {
  cv::imwrite(Path("grey.png"), cv::Mat(80, 90, CV_8UC1, cv::Scalar(128)));
  const Outcome outcome = RunProgram("match " + Path("a.png") + " " + Path("grey.png") +
                                     " --features orb --output " + Path("m.png"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("0 matches, 0 inliers (none matrix)"));
}

TEST_F(MatchCommand, BadInputIsOneSentence) {
  const std::string output = " --output " + Path("m.png");
  const std::string lift = "--features lift --weights " + Path("w.safetensors") + output;
  for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
           {Path("a.png") + " " + Path("none.png") + " --features orb" + output, "none.png"},
           {Images() + "--features surf" + output, "'surf' is unknown"},
           {Images() + "--features lift --weights none" + output, "none"},
           {Images() + " --turned " + lift, "--turned"},
           {Path("a.png") + " " + Path("tiny.png") + " --upright " + lift, "tiny.png"},
           {Images() + "--features orb --weights " + Path("w.safetensors") + output, "not orb"},
           {Images() + "--features lift --weights " + Path("a.png") + output, "a.png"},
           {Images() + "--features orb --gamma 0" + output, "--gamma"},
           {Images() + "--features orb --gamma nan" + output, "--gamma"},
           {Images() + "--features orb --ratio 2" + output, "--ratio"},
           {Images() + "--features orb --best 0" + output, "--best"},
           {Images() + "--features orb --max-features 0.5" + output, "max-features"},
           {Images() + "--features orb --output " + Path("m.txt"), ".png"},
           {Path("a.png") + " " + Path("tiny.png") + " --features orb --camera " +
                Path("camera.yaml") + output,
            "320 x 240"}}) {
    const Outcome outcome = RunProgram("match " + arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: "));
    EXPECT_THAT(outcome.output, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace lift_slam
