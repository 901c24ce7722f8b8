#include "lift_slam/image/pyramid.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lift_slam {
namespace {

// Grey value = x / 2 + y / 4.
GrayImage Ramp(int width, int height) {
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at<uchar>(y, x) = static_cast<uchar>(x / 2 + y / 4);
  }
  return GrayImage(image);
}

TEST(Pyramid, LevelsShrinkByTheFactor) {
  const ImagePyramid pyramid = BuildPyramid(Ramp(400, 300), {.num_levels = 4, .scale_factor = 2.0});
  ASSERT_EQ(pyramid.size(), 4U);
  EXPECT_EQ(pyramid[0].image.width(), 400);
  EXPECT_EQ(pyramid[1].image.width(), 200);
  EXPECT_EQ(pyramid[3].image.height(), 38);
  EXPECT_DOUBLE_EQ(pyramid[3].scale_y, 300.0 / 38.0);
}

TEST(Pyramid, LevelZeroSharesThePixels) {
  const GrayImage image = Ramp(40, 30);
  EXPECT_EQ(BuildPyramid(image, {})[0].image.row(0), image.row(0));
}

// Mean difference between a level and the ramp at the mapped places.
double MeanError(const PyramidLevel& level, bool is_inverted) {
  double sum = 0.0;
  int count = 0;
  for (int y = 5; y < level.image.height() - 5; ++y) {
    for (int x = 5; x < level.image.width() - 5; ++x, ++count) {
      const double expected = level.FullX(x) / 2.0 + level.FullY(y) / 4.0;
      sum += level.image.row(y)[x] - (is_inverted ? 255.0 - expected : expected);
    }
  }
  return sum / count;
}

TEST(Pyramid, EachLevelShowsTheSameSceneAtTheMappedPlace) {
  const GrayImage ramp = Ramp(300, 240);
  const cv::Mat inverted = 255 - ramp.mat();
  const ImagePyramid rising = BuildPyramid(ramp, {}),
                     falling = BuildPyramid(GrayImage(inverted), {});
  // A shift errs with opposite signs on the two; OpenCV's rounding down (0.1 a level) cancels.
  const auto shift_error = [&](std::size_t i) {
    return 0.5 * (MeanError(rising[i], false) - MeanError(falling[i], true));
  };
  // Without the half pixel of the centre the last level would be 0.97 off.
  for (std::size_t i = 1; i < 8; ++i) EXPECT_NEAR(shift_error(i), shift_error(0), 0.03) << i;
}

TEST(Pyramid, RebuildingInPlaceEqualsBuilding) {
  ImagePyramid pyramid;
  for (const GrayImage& image : {Ramp(200, 100), GrayImage(255 - Ramp(200, 100).mat()),
                                 Ramp(90, 120), Ramp(10, 10), Ramp(200, 100)}) {
    RebuildPyramid(image, {}, pyramid);
    const ImagePyramid expected = BuildPyramid(image, {});
    ASSERT_EQ(pyramid.size(), expected.size());
    for (std::size_t i = 0; i < pyramid.size(); ++i) {
      EXPECT_EQ(cv::norm(pyramid[i].image.mat(), expected[i].image.mat(), cv::NORM_INF), 0.0);
    }
  }
}

TEST(Pyramid, EndsBeforeLevelsGetTooSmall) {
  EXPECT_TRUE(BuildPyramid(GrayImage(), {}).empty());
  EXPECT_TRUE(BuildPyramid(Ramp(100, 38), {.min_size_px = 39}).empty());
  EXPECT_EQ(BuildPyramid(Ramp(64, 48), {.min_size_px = 39}).size(), 2U);
  EXPECT_EQ(BuildPyramid(Ramp(1, 1), {}).size(), 1U + 3U);  // 1 / 1.2^3 still rounds to 1
}

}  // namespace
}  // namespace lift_slam
