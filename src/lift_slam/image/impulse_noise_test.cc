#include "lift_slam/image/impulse_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/image/image_distortion.h"

namespace lift_slam {
namespace {

// Smooth hills with sensor noise, blocks in the darkest and the brightest tone, and saturated sky.
GrayImage Scene() {
  cv::Mat image(240, 320, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<uchar>(y, x) =
          cv::saturate_cast<uchar>(128 + 70 * std::sin(0.13 * x) * std::cos(0.11 * y));
    }
  }
  cv::rectangle(image, {0, 0, 320, 30}, cv::Scalar(255), cv::FILLED);
  cv::rectangle(image, {20, 60, 60, 60}, cv::Scalar(0), cv::FILLED);
  const GrayImage noisy = Distort(GrayImage(image), ParseImageDistortions("noise=2"), 5, 0);
  return noisy;
}

GrayImage With(const std::string& text) {
  return Distort(Scene(), ParseImageDistortions(text), 3, 1);
}

int CountDifferent(const GrayImage& a, const GrayImage& b, int tolerance) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      count += std::abs(a.row(y)[x] - b.row(y)[x]) > tolerance ? 1 : 0;
    }
  }
  return count;
}

TEST(ImpulseNoise, CleanImagesStayAsTheyAre) {
  for (const char* text : {"gamma=1", "gamma=0.25", "gamma=0.5", "gamma=2", "gamma=4", "q1", "q3",
                           "q1,q3", "q1-clip", "q3-clip", "noise=10", "blur=2"}) {
    const GrayImage image = With(text);
    const ImpulseNoiseResult result = RemoveImpulseNoise(image, {});
    EXPECT_FALSE(result.is_noisy) << text;
    EXPECT_EQ(result.image.mat().data, image.mat().data) << text;
    EXPECT_EQ(result.num_replaced, 0) << text;
  }
}

TEST(ImpulseNoise, IsTakenOutFromHalfAPercentToThirty) {
  const int num_pixels = 320 * 240;
  for (const double share : {0.005, 0.02, 0.05, 0.1, 0.3}) {
    const GrayImage noisy = With("salt-pepper=" + std::to_string(share));
    const ImpulseNoiseResult result = RemoveImpulseNoise(noisy, {});
    EXPECT_TRUE(result.is_noisy) << share;
    const int before = CountDifferent(noisy, Scene(), 25);
    const int after = CountDifferent(result.image, Scene(), 25);
    EXPECT_LT(after, 0.1 * before) << share;
    // In the black and the white areas (a sixth) half of the noise is no change.
    EXPECT_NEAR(result.num_replaced, share * num_pixels, 0.2 * share * num_pixels + 100);
  }
}

TEST(ImpulseNoise, OnlyDamagedPixelsChange) {
  const GrayImage noisy = With("salt-pepper=0.05");
  const ImpulseNoiseResult result = RemoveImpulseNoise(noisy, {});
  int changed = 0;
  for (int y = 0; y < noisy.height(); ++y) {
    for (int x = 0; x < noisy.width(); ++x) {
      if (noisy.row(y)[x] == result.image.row(y)[x]) continue;
      ++changed;
      EXPECT_TRUE(noisy.row(y)[x] == 0 || noisy.row(y)[x] == 255);
    }
  }
  EXPECT_LE(changed, result.num_replaced);
}

TEST(ImpulseNoise, WorksOnDarkAndTruncatedImages) {
  for (const char* text : {"gamma=2", "gamma=0.25", "q1", "q3"}) {
    const std::string chain = std::string(text) + ",salt-pepper=0.05";
    EXPECT_TRUE(RemoveImpulseNoise(With(chain), {}).is_noisy) << text;
  }
}

TEST(ImpulseNoise, SaltAloneIsNotTakenForNoise) {
  cv::Mat pixels = With("gamma=2").mat().clone();
  for (int y = 40; y < 230; y += 4) {
    for (int x = 4; x < 310; x += 4) pixels.at<uchar>(y, x) = 255;
  }
  EXPECT_FALSE(RemoveImpulseNoise(GrayImage(pixels), {}).is_noisy);
}

TEST(ImpulseNoise, TinyAndEmptyImagesPass) {
  EXPECT_FALSE(RemoveImpulseNoise(GrayImage(), {}).is_noisy);
  EXPECT_FALSE(RemoveImpulseNoise(GrayImage(cv::Mat::zeros(1, 1, CV_8UC1)), {}).is_noisy);
}

}  // namespace
}  // namespace lift_slam
