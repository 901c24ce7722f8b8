#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/image/gamma.h"
#include "lift_slam/image/noise.h"
#include "lift_slam/image/warp.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

GrayImage Ramp() {
  cv::Mat image(32, 256, CV_8UC1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 256; ++x) image.at<uchar>(y, x) = static_cast<uchar>(x);
  }
  return GrayImage(image);
}

TEST(ApplyGamma, IsAPowerOfTheGreyValue) {
  const GrayImage dark = ApplyGamma(Ramp(), 2.0);
  EXPECT_EQ(dark.row(3)[0], 0);
  EXPECT_EQ(dark.row(3)[128], 64);  // 255 (128 / 255)^2 = 64.25
  EXPECT_EQ(dark.row(3)[255], 255);
  EXPECT_EQ(ApplyGamma(Ramp(), 0.5).row(3)[64], 128);  // 255 sqrt(64 / 255) = 127.75
  EXPECT_EQ(ApplyGamma(Ramp(), 1.0).row(3)[77], 77);
  EXPECT_THROW(ApplyGamma(Ramp(), 0.0), CheckError);
}

TEST(WarpImage, CarriesPixelsAlongTheHomography) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = 10.0;
  const GrayImage warped = WarpImage(Ramp(), shift);
  EXPECT_EQ(warped.width(), 256);
  EXPECT_EQ(warped.row(5)[110], 100);
}

TEST(AddNoise, HasTheDeviationAskedFor) {
  Random random(1);
  const GrayImage noisy = AddNoise(Ramp(), 3.0, random);
  double sum = 0.0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 32; x < 224; ++x) sum += std::pow(noisy.row(y)[x] - x, 2);
  }
  EXPECT_NEAR(std::sqrt(sum / (32 * 192)), 3.0, 0.15);
}

}  // namespace
}  // namespace lift_slam
