#include "lift_slam/features/sift/sift_extractor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

GrayImage Blob(double x, double y, double sigma) {
  cv::Mat image(100, 120, CV_8UC1);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const double squared = (column - x) * (column - x) + (row - y) * (row - y);
      image.at<uchar>(row, column) =
          static_cast<uchar>(std::lround(20 + 200 * std::exp(-squared / (2 * sigma * sigma))));
    }
  }
  return GrayImage(image);
}

TEST(SiftExtractor, FindsABlobWhereItIsWithItsScale) {
  SiftExtractor extractor({});
  const FeatureSet features = extractor.Extract(Blob(60.3, 48.6, 4.0));
  ASSERT_GE(features.keypoints.size(), 1U);
  ASSERT_EQ(features.descriptors.size(), features.keypoints.size());
  const auto strongest = std::max_element(
      features.keypoints.begin(), features.keypoints.end(),
      [](const Keypoint& a, const Keypoint& b) { return a.response < b.response; });
  EXPECT_NEAR(strongest->x, 60.3, 0.1);
  EXPECT_NEAR(strongest->y, 48.6, 0.1);
  EXPECT_NEAR(extractor.scale_levels().Scale(strongest->level), 4.0, 0.6);
}

TEST(SiftExtractor, NothingToSeeGivesNothing) {
  SiftExtractor extractor({});
  EXPECT_TRUE(
      extractor.Extract(GrayImage(cv::Mat(7, 5, CV_8UC1, cv::Scalar(9)))).keypoints.empty());
  EXPECT_TRUE(extractor.Extract(GrayImage()).keypoints.empty());
  EXPECT_THROW(SiftExtractor({.max_features = -1}), InputError);
}

}  // namespace
}  // namespace lift_slam
