#include "lift_slam/features/lift/keypoint_detection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/image/resize.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kWidth = 310, kHeight = 230;

// A smooth peak in the full-size image and in scale.
struct Blob {
  double x = 0.0, y = 0.0, sigma = 4.0;
  double widths_x = 2.5, widths_y = 2.5;  // deviation along x and y, in sigmas
};

// What a detector with such a response would give on the levels, at the exact centres of pixels.
std::vector<ScoreLevel> LevelsOf(const Blob& blob) {
  std::vector<ScoreLevel> levels;
  for (const ScaleLevel& shape : MakeScaleLevels(kWidth, kHeight, 0)) {
    ScoreLevel level{.shape = shape,
                     .border = 12,
                     .width = shape.width - 24,
                     .height = shape.height - 24,
                     .scores = {}};
    const double octaves = std::log2(shape.sigma / blob.sigma);
    for (int y = 12; y < shape.height - 12; ++y) {
      for (int x = 12; x < shape.width - 12; ++x) {
        const double dx = (x + 0.5) * kWidth / shape.width - 0.5 - blob.x;
        const double dy = (y + 0.5) * kHeight / shape.height - 0.5 - blob.y;
        level.scores.push_back(static_cast<float>(
            std::exp(-0.5 * (std::pow(dx / (blob.widths_x * blob.sigma), 2) +
                             std::pow(dy / (blob.widths_y * blob.sigma), 2) + octaves * octaves))));
      }
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

std::vector<LiftKeypoint> Find(const Blob& blob, const LiftDetectorOptions& options) {
  nn::WorkerTeam team(2);
  return FindKeypoints(LevelsOf(blob), options, team);
}

TEST(KeypointDetection, BlobIsFoundToATenthOfAPixelOfItsLevel) {
  Random random(2);
  for (int i = 0; i < 12; ++i) {
    const Blob blob{.x = random.Uniform(120, 190),
                    .y = random.Uniform(100, 130),
                    .sigma = random.Uniform(2, 5)};
    const std::vector<LiftKeypoint> found = Find(blob, {});
    ASSERT_EQ(found.size(), 1U);
    const double pixel = blob.sigma / 1.958;
    EXPECT_NEAR(found[0].x, blob.x, 0.1 * pixel);
    EXPECT_NEAR(found[0].y, blob.y, 0.1 * pixel);
    EXPECT_NEAR(std::log2(found[0].sigma / blob.sigma), 0.0, 0.04);
    EXPECT_NEAR(found[0].score, 1.0F, 0.03F);
  }
}

TEST(KeypointDetection, OriginalCoordinatesAreOffByHalfAPixelOfBothSizes) {
  const Blob blob{.x = 150.3, .y = 110.8, .sigma = 7.0};
  const std::vector<LiftKeypoint> found =
      Find(blob, {.nms_levels = 2, .coordinates = LevelCoordinates::kOriginal});
  ASSERT_EQ(found.size(), 1U);
  const double offset = 0.5 * (7.0 / 1.958 - 1);
  EXPECT_NEAR(found[0].x, blob.x - offset, 0.6);
  EXPECT_NEAR(found[0].y, blob.y - offset, 0.6);
}

TEST(KeypointDetection, RidgesAreLeftOut) {
  EXPECT_EQ(Find({.x = 150, .y = 110, .widths_x = 1.5, .widths_y = 4.0}, {}).size(), 1U);
  EXPECT_TRUE(Find({.x = 150, .y = 110, .widths_x = 1.5, .widths_y = 6.0}, {}).empty());
  EXPECT_EQ(
      Find({.x = 150, .y = 110, .widths_x = 1.5, .widths_y = 6.0}, {.max_edge_ratio = 30.0}).size(),
      1U);
}

TEST(KeypointDetection, FirstLevelLeavesSmallScalesOut) {
  nn::WorkerTeam team(1);
  const std::vector<ScoreLevel> levels = LevelsOf({.x = 150, .y = 110, .sigma = 1.6});
  EXPECT_EQ(FindKeypoints(levels, {}, team).size(), 1U);
  EXPECT_TRUE(FindKeypoints(std::span(levels).subspan(5), {}, team).empty());
}

TEST(ScaleLevels, AreTheAuthors) {
  const std::vector<ScaleLevel> kitti = MakeScaleLevels(1241, 376, 0);
  ASSERT_EQ(kitti.size(), 21U);
  EXPECT_EQ(kitti[0].width, 2430);  // 23.5 / 12 times
  EXPECT_EQ(kitti[0].height, 736);
  EXPECT_EQ(kitti[20].height, 46);
  EXPECT_DOUBLE_EQ(kitti[10].sigma, 4.0);
  EXPECT_EQ(MakeScaleLevels(1241, 376, 5).size(), 16U);
  EXPECT_LT(MakeScaleLevels(100, 80, 0).size(), 21U);
}

// Resampling a ramp shows where the pixels of a level lie, to within the rounding of OpenCV.
TEST(ScaleLevels, ExactCoordinatesAreWhereResamplingReads) {
  constexpr int kRampWidth = 200;
  cv::Mat ramp(120, kRampWidth, CV_8UC1);
  for (int x = 0; x < kRampWidth; ++x) ramp.col(x).setTo(x);
  double largest_error_of_original = 0.0;
  for (const ScaleLevel& level : MakeScaleLevels(kRampWidth, 120, 0)) {
    const GrayImage resized = Resize(GrayImage(ramp), level.width, level.height);
    for (int x = 2; x < level.width - 2; ++x) {
      const LevelPosition pixel{static_cast<double>(x), 5.0};
      const double value = resized.row(5)[x];
      EXPECT_NEAR(ToFullSize(level, pixel, LevelCoordinates::kExact).x, value, 0.75);
      largest_error_of_original =
          std::max(largest_error_of_original,
                   std::abs(ToFullSize(level, pixel, LevelCoordinates::kOriginal).x - value));
    }
  }
  EXPECT_GT(largest_error_of_original, 1.0);
}

TEST(LiftDetectorOptions, OutOfRangeIsRefused) {
  EXPECT_THROW(KeypointDetector({.nms_levels = 0}), InputError);
  EXPECT_THROW(KeypointDetector({.first_level = 20}), InputError);
  EXPECT_THROW(KeypointDetector({.max_edge_ratio = std::nan("")}), InputError);
}

}  // namespace
}  // namespace lift_slam
