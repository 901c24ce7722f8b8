#include "lift_slam/features/orb/corner_orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// Brightness that rises in direction `angle_rad`.
GrayImage Ramp(double angle_rad) {
  cv::Mat image(64, 64, CV_8UC1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double along = (x - 32) * std::cos(angle_rad) + (y - 32) * std::sin(angle_rad);
      image.at<uchar>(y, x) = static_cast<uchar>(std::lround(128.0 + 2.5 * along));
    }
  }
  return GrayImage(image);
}

TEST(IntensityCentroidAngle, FollowsTheGradient) {
  for (const double angle_rad : {0.0, 0.4, 1.7, 3.0, -0.4, -1.7, -3.0}) {
    EXPECT_NEAR(IntensityCentroidAngle(Ramp(angle_rad), 32, 32), angle_rad, 0.01);
  }
}

TEST(IntensityCentroidAngle, EqualsThePlainSumOverTheDisc) {
  Random random(2);
  cv::Mat image(40, 41, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<uchar>(y, x) = static_cast<uchar>(random.UniformInt(0, 255));
  }
  double moment_x = 0.0, moment_y = 0.0;
  for (int v = -15; v <= 15; ++v) {
    for (int u = -15; u <= 15; ++u) {
      if (u * u + v * v > 15.5 * 15.5) continue;
      moment_x += u * image.at<uchar>(20 + v, 20 + u);
      moment_y += v * image.at<uchar>(20 + v, 20 + u);
    }
  }
  EXPECT_FLOAT_EQ(IntensityCentroidAngle(GrayImage(image), 20, 20),
                  static_cast<float>(std::atan2(moment_y, moment_x)));
}

TEST(IntensityCentroidAngle, ExtremeContrastDoesNotOverflow) {
  cv::Mat image(40, 40, CV_8UC1, cv::Scalar(0));
  image.rowRange(21, 40) = 255;
  EXPECT_NEAR(IntensityCentroidAngle(GrayImage(image), 20, 20), std::numbers::pi / 2.0, 1e-6);
  EXPECT_EQ(IntensityCentroidAngle(GrayImage(cv::Mat(40, 40, CV_8UC1, cv::Scalar(255))), 20, 20),
            0.0F);
}

}  // namespace
}  // namespace lift_slam
