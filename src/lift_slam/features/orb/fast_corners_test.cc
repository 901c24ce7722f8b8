#include "lift_slam/features/orb/fast_corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "lift_slam/features/orb/corner_refinement.h"
#include "lift_slam/features/orb/noise_image_for_test.h"

namespace lift_slam {
namespace {

constexpr int kBorder = 16;

// Corners of all strengths, and equal neighbours.
cv::Mat BlurredNoiseImage(int width, int height, std::uint64_t seed) {
  cv::Mat image = NoiseImage(width, height, seed);
  cv::GaussianBlur(image, image, {5, 5}, 1.2);
  return image;
}

std::vector<Corner> Find(const cv::Mat& image, int threshold) {
  FastScoreMap map;
  map.Compute(GrayImage(image), kBorder);
  std::vector<Corner> corners;
  map.FindCorners(threshold, corners);
  return corners;
}

using ScoreByPosition = std::map<std::pair<int, int>, int>;

ScoreByPosition OpenCvCorners(const cv::Mat& image, int threshold, bool suppress) {
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, threshold, suppress);
  ScoreByPosition scores;
  for (const cv::KeyPoint& k : keypoints) {
    const int x = cvRound(k.pt.x), y = cvRound(k.pt.y);
    if (x < kBorder || y < kBorder || x >= image.cols - kBorder || y >= image.rows - kBorder)
      continue;
    scores[{y, x}] = cvRound(k.response);
  }
  return scores;
}

class FastCornersOfSize : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(FastCornersOfSize, ContainOpenCvsWithTheSameScore) {
  const cv::Mat image = BlurredNoiseImage(GetParam().first, GetParam().second, 3);
  ScoreByPosition ours;
  for (const Corner& corner : Find(image, 12)) ours[{corner.y, corner.x}] = corner.score;
  const ScoreByPosition theirs = OpenCvCorners(image, 12, /*suppress=*/true);
  for (const auto& [position, score] : theirs) {
    ASSERT_TRUE(ours.contains(position)) << position.second << ", " << position.first;
    EXPECT_EQ(ours[position], score + 1);  // OpenCV reports the largest threshold passed
  }
  // Of equal neighbours OpenCV drops all; beyond those, nothing is added.
  const ScoreByPosition candidates = OpenCvCorners(image, 12, /*suppress=*/false);
  for (const auto& [position, score] : ours) EXPECT_TRUE(candidates.contains(position));
  EXPECT_GE(ours.size(), theirs.size());
  EXPECT_LE(ours.size(), theirs.size() + theirs.size() / 5 + 2);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FastCornersOfSize,
                         testing::Values(std::pair{200, 150}, std::pair{41, 39}, std::pair{33, 33},
                                         std::pair{40, 300}, std::pair{333, 37}));

TEST(FastCorners, OfEqualNeighboursTheFirstIsKept) {
  cv::Mat image(40, 40, CV_8UC1, cv::Scalar(10));
  image(cv::Rect(20, 20, 2, 1)) = 200;
  const std::vector<Corner> corners = Find(image, 20);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0].x, 20);
  EXPECT_EQ(corners[0].y, 20);
  EXPECT_EQ(corners[0].score, 190);
}

TEST(FastCorners, RefinementFollowsAShiftBelowAPixel) {
  // A soft spot whose centre moves by parts of a pixel.
  for (const double shift : {-0.4, -0.2, 0.0, 0.3}) {
    cv::Mat image(41, 41, CV_8UC1);
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) {
        const double u = x - 20.0 - shift, v = y - 20.0 + 0.5 * shift;
        image.at<uchar>(y, x) =
            cv::saturate_cast<uchar>(20.0 + 220.0 * std::exp(-(u * u + v * v) / 8.0));
      }
    }
    FastScoreMap map;
    map.Compute(GrayImage(image), kBorder);
    const RefinedPosition position = RefineCorner(map, {20, 20, map.Score(20, 20)});
    EXPECT_NEAR(position.x, 20.0 + shift, 0.1);
    EXPECT_NEAR(position.y, 20.0 - 0.5 * shift, 0.1);
  }
}

TEST(FastCorners, NoneInUniformOrTinyImages) {
  EXPECT_TRUE(Find(cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)), 1).empty());
  EXPECT_TRUE(Find(cv::Mat(48, 64, CV_8UC1, cv::Scalar(255)), 1).empty());
  EXPECT_TRUE(Find(cv::Mat(5, 5, CV_8UC1, cv::Scalar(0)), 1).empty());
}

TEST(FastCorners, WorkOnPartOfALargerImage) {
  const cv::Mat whole = BlurredNoiseImage(160, 120, 5);
  const cv::Mat part = whole(cv::Rect(40, 30, 70, 60));
  const std::vector<Corner> of_view = Find(part, 10), of_copy = Find(part.clone(), 10);
  ASSERT_EQ(of_view.size(), of_copy.size());
  EXPECT_GT(of_view.size(), 0U);
  for (std::size_t i = 0; i < of_view.size(); ++i) {
    EXPECT_EQ(of_view[i].x, of_copy[i].x);
    EXPECT_EQ(of_view[i].y, of_copy[i].y);
    EXPECT_EQ(of_view[i].score, of_copy[i].score);
  }
}

}  // namespace
}  // namespace lift_slam
