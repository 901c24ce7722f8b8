#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "apps/program_for_test.h"
#include "lift_slam/image/image_distortion.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class DistortCommand : public testing::Test {
 protected:
  void SetUp() override {
    cv::Mat image(60, 200, CV_8UC1);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 200; ++x) image.at<uchar>(y, x) = static_cast<uchar>(x + y / 2);
    }
    cv::imwrite(Path("a.png"), image);
    cv::imwrite(Path("b.png"), image);
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  cv::Mat Read(const std::string& name) const { return cv::imread(Path(name), -1); }

  TemporaryFolder folder_;
};

TEST_F(DistortCommand, WritesEachImageAsARunSeesIt) {
  const Outcome outcome =
      RunProgram("distort " + Path("a.png") + " " + Path("b.png") +
                 " --distort q1,salt-pepper=0.1 --seed 4 --output " + Path("out"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto chain = ParseImageDistortions("q1,salt-pepper=0.1");
  const GrayImage second = Distort(GrayImage(Read("b.png")), chain, 4, 1);
  EXPECT_EQ(cv::norm(Read("out/b.png"), second.mat(), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(Read("out/a.png"), second.mat(), cv::NORM_INF), 0.0);
}

TEST_F(DistortCommand, DrawsTheConditions) {
  const Outcome outcome =
      RunProgram("distort " + Path("a.png") + " --figure " + Path("figure.png"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_GT(Read("figure.png").cols, 1000);
}

TEST_F(DistortCommand, BadArgumentsAreExplained) {
  const std::pair<std::string, std::string> cases[] = {
      {Path("a.png") + " --distort fog --output " + Path("out"), "'fog' is unknown"},
      {Path("a.png") + " --distort q1", "--output FOLDER with --distort SPEC"},
      {Path("a.png"), "--figure FILE.png"},
      {Path("a.png") + " --figure x.jpg", "must end in .png"},
      {Path("none.png") + " --distort q1 --output " + Path("out"), "no such file"},
      {Path("a.png") + " " + Path("a.png") + " --distort q1 --output " + Path("out"),
       "two images are called 'a'"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = RunProgram("distort " + arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, HasSubstr(message));
  }
}

}  // namespace
}  // namespace lift_slam
