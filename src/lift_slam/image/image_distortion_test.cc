#include "lift_slam/image/image_distortion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

// Every value from 0 to 199 equally often.
GrayImage Ramp() {
  cv::Mat image(50, 200, CV_8UC1);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 200; ++x) image.at<uchar>(y, x) = static_cast<uchar>(x);
  }
  return GrayImage(image);
}

GrayImage After(const std::string& text, std::uint64_t seed = 0, std::int64_t frame = 0) {
  return Distort(Ramp(), ParseImageDistortions(text), seed, frame);
}

bool Equal(const GrayImage& a, const GrayImage& b) {
  return cv::norm(a.mat(), b.mat(), cv::NORM_INF) == 0.0;
}

std::string ParseMessage(const std::string& text) {
  try {
    ParseImageDistortions(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImageDistortion, TextIsParsedAndWrittenBack) {
  EXPECT_EQ(ToText(ParseImageDistortions("gamma=0.250,q1,salt-pepper=0.02")),
            "gamma=0.25,q1,salt-pepper=0.02");
  EXPECT_EQ(ToText(ParseImageDistortions("q3-clip")), "q3-clip");
}

TEST(ImageDistortion, BadTextIsExplained) {
  EXPECT_THAT(ParseMessage("fog"), HasSubstr("'fog' is unknown; expected gamma=G"));
  EXPECT_THAT(ParseMessage(""), HasSubstr("'' is unknown"));
  EXPECT_THAT(ParseMessage("q1,"), HasSubstr("'' is unknown"));
  EXPECT_THAT(ParseMessage("gamma"), HasSubstr("expected gamma= and a number from 0.01 to 100"));
  EXPECT_THAT(ParseMessage("gamma=nan"), HasSubstr("a number from 0.01 to 100"));
  EXPECT_THAT(ParseMessage("salt-pepper=1.5"), HasSubstr("a share of pixels from 0 to 1"));
  EXPECT_THAT(ParseMessage("q1=3"), HasSubstr("q1 takes no number"));
}

TEST(ImageDistortion, GammaIsAPowerOfTheGreyValue) {
  EXPECT_EQ(After("gamma=2").row(0)[128], 64);
  EXPECT_EQ(After("gamma=0.5").row(0)[64], 128);
}

TEST(ImageDistortion, TruncationLosesTheDarkOrTheBrightQuarter) {
  EXPECT_EQ(GrayQuantile(Ramp(), 0.25), 49);
  EXPECT_EQ(GrayQuantile(Ramp(), 0.75), 149);
  const GrayImage q1 = After("q1"), q3 = After("q3");
  EXPECT_EQ(q1.row(0)[49], 0);
  EXPECT_EQ(q1.row(0)[50], 50);
  EXPECT_EQ(q3.row(0)[149], 255);
  EXPECT_EQ(q3.row(0)[148], 148);
}

TEST(ImageDistortion, ClippedTruncationKeepsThePercentile) {
  const GrayImage q1 = After("q1-clip"), q3 = After("q3-clip");
  EXPECT_EQ(q1.row(0)[3], 49);
  EXPECT_EQ(q1.row(0)[50], 50);
  EXPECT_EQ(q3.row(0)[190], 149);
  EXPECT_EQ(q3.row(0)[148], 148);
}

TEST(ImageDistortion, SaltAndPepperHasItsShareAndBothKinds) {
  const GrayImage noisy = After("salt-pepper=0.1");
  int salt = 0, pepper = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 1; x < 200; ++x) {
      salt += noisy.row(y)[x] == 255 ? 1 : 0;
      pepper += noisy.row(y)[x] == 0 ? 1 : 0;
    }
  }
  EXPECT_NEAR(salt, 500, 70);  // 5 % of 9950; 3 sigma
  EXPECT_NEAR(pepper, 500, 70);
  EXPECT_TRUE(Equal(After("salt-pepper=0"), Ramp()));
}

TEST(ImageDistortion, RandomOnesDependOnSeedAndFrameAlone) {
  for (const char* text : {"salt-pepper=0.1", "noise=5"}) {
    EXPECT_TRUE(Equal(After(text, 1, 7), After(text, 1, 7)));
    EXPECT_FALSE(Equal(After(text, 1, 7), After(text, 1, 8)));
    EXPECT_FALSE(Equal(After(text, 1, 7), After(text, 2, 7)));
  }
}

TEST(ImageDistortion, BlurTakesContrastAway) {
  const GrayImage noisy = After("noise=20"), blurred = After("noise=20,blur=2");
  const auto roughness = [](const GrayImage& image) {
    double sum = 0.0;
    for (int x = 50; x < 150; ++x) sum += std::abs(image.row(25)[x + 1] - image.row(25)[x]);
    return sum;
  };
  EXPECT_LT(roughness(blurred), 0.3 * roughness(noisy));
  EXPECT_TRUE(Equal(After("blur=0"), Ramp()));
}

TEST(ImageDistortion, ChainsAreAppliedInOrder) {
  EXPECT_FALSE(Equal(After("blur=2,q1"), After("q1,blur=2")));
  EXPECT_TRUE(Distort(GrayImage(), ParseImageDistortions("q1"), 0, 0).empty());
}

}  // namespace
}  // namespace lift_slam
