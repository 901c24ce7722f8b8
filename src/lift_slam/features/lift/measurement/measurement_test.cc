#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "lift_slam/features/lift/measurement/descriptor_distances.h"
#include "lift_slam/features/lift/measurement/keypoint_pairs.h"
#include "lift_slam/features/lift/measurement/weights_measurement.h"
#include "lift_slam/testing/texture.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

GrayImage Picture(int width, int height, float shift = 0.0F) {
  const Texture texture = MakeTexture(TextureKind::kClutter, 2);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(
          texture.Sample(static_cast<float>(x) + shift, static_cast<float>(y), 0.5F));
    }
  }
  return GrayImage(image);
}

TEST(KeypointPairs, WarpedImageHasThePairsAtTheRightPlaces) {
  const GrayImage image = Picture(320, 240);
  Random random(1), same(1);
  const WarpOptions options;
  const KeypointPairs pairs = PairsByWarp(image, FindBlobs, 100, options, random);
  const Eigen::Matrix3d warp = RandomWarp(image, options, same);
  ASSERT_GT(pairs.in_a.size(), 20U);
  ASSERT_EQ(pairs.in_a.size(), pairs.in_b.size());
  EXPECT_LE(pairs.in_a.size(), 100U);
  for (std::size_t i = 0; i < pairs.in_a.size(); ++i) {
    const LiftKeypoint place = Warped(pairs.in_a[i], warp);
    EXPECT_LT(std::hypot(place.x - pairs.in_b[i].x, place.y - pairs.in_b[i].y),
              0.5 * place.sigma + 1e-9);
    EXPECT_NEAR(std::log2(place.sigma / pairs.in_b[i].sigma), 0.0, 0.33);
  }
}

TEST(KeypointPairs, WarpedSizeIsThatOfItsNeighbourhood) {
  Random random(5);
  const Eigen::Matrix3d warp = RandomWarp(Picture(320, 240), {}, random);
  const LiftKeypoint k{200, 90, 1.0, 0};
  const LiftKeypoint middle = Warped(k, warp);
  const auto step = [&](double dx, double dy) -> Eigen::Vector2d {
    const LiftKeypoint there = Warped({k.x + dx, k.y + dy, 1.0, 0}, warp);
    return Eigen::Vector2d(there.x - middle.x, there.y - middle.y) / 1e-4;
  };
  Eigen::Matrix2d jacobian;
  jacobian << step(1e-4, 0), step(0, 1e-4);
  EXPECT_NEAR(middle.sigma, std::sqrt(jacobian.determinant()), 1e-3);
}

TEST(KeypointPairs, PhotographsOfOneSceneArePairedBySift) {
  const KeypointPairs pairs = PairsBySift(Picture(320, 240), Picture(320, 240, 12.0F), nullptr, 40);
  ASSERT_EQ(pairs.in_a.size(), 40U);
  int num_right = 0;
  for (std::size_t i = 0; i < pairs.in_a.size(); ++i) {
    num_right +=
        std::hypot(pairs.in_a[i].x - 12 - pairs.in_b[i].x, pairs.in_a[i].y - pairs.in_b[i].y) < 1.0;
  }
  EXPECT_GE(num_right, 38);
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_FLOAT_EQ(Quantile({3, 1, 2}, 0.5), 2.0F);
  EXPECT_FLOAT_EQ(Quantile({4, 1, 2, 3}, 0.5), 2.5F);
  EXPECT_FLOAT_EQ(Quantile({4, 1, 2, 3}, 1.0), 4.0F);
  EXPECT_FLOAT_EQ(Quantile({7}, 0.3), 7.0F);
  EXPECT_FLOAT_EQ(Quantile({}, 0.3), 0.0F);
}

// Three places on a line 100 pixels apart and one 1 pixel from the first, whose descriptors are
// their distance from the first, and off by 0.5 in the second image.
TEST(AppendDistances, NeighboursAreNeitherRightNorWrong) {
  KeypointPairs pairs;
  std::vector<float> a(4 * 128), b(4 * 128);
  const double places[] = {0, 100, 200, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    pairs.in_a.push_back({places[i], 0, 2.0, 0});
    pairs.in_b.push_back({places[i], 0, 2.0, 0});
    a[128 * i] = static_cast<float>(places[i]);
    b[128 * i] = static_cast<float>(places[i] + 0.5);
  }
  DistanceSamples samples;
  AppendDistances(pairs, a, b, samples);
  EXPECT_EQ(samples.matching, std::vector<float>({0.5F, 0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(samples.nearest_wrong, std::vector<float>({100.5F, 98.5F, 99.5F, 99.5F}));
  EXPECT_EQ(samples.wrong.size(), 10U);
  EXPECT_EQ(samples.num_nearest_is_right, 4U);
  EXPECT_EQ(FalsePositiveRateAt95(samples), 0.0);
}

TEST(FalsePositiveRateAt95, CountsWrongPairsWithinTheLimit) {
  DistanceSamples samples;
  for (int i = 0; i <= 100; ++i) samples.matching.push_back(static_cast<float>(i));  // limit 95
  for (int i = 0; i < 10; ++i) samples.wrong.push_back(static_cast<float>(90 + 2 * i));
  EXPECT_DOUBLE_EQ(FalsePositiveRateAt95(samples).value(), 0.3);
}

TEST(FalsePositiveRateAt95, IsNothingWithoutPairs) {
  DistanceSamples samples;
  EXPECT_FALSE(FalsePositiveRateAt95(samples));
  samples.matching = {1.0F};
  EXPECT_FALSE(FalsePositiveRateAt95(samples));
}

TEST(WeightsMeasurement, SameInputGivesTheSameNumbers) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
  const GrayImage images[] = {Picture(200, 160), Picture(180, 170, 60.0F)};
  const auto ranges = MeasureRangesOnImages(weights, images, 6, 1);
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_LE(ranges[0], 1.0F);  // (grey - 128) / 128
  EXPECT_GT(ranges[0], 0.3F);
  EXPECT_EQ(ranges, MeasureRangesOnImages(weights, images, 6, 1));
  EXPECT_NE(ranges, MeasureRangesOnImages(weights, images, 6, 2));
}

// What repeats of a random detector is little, but a descriptor of random filters works.
TEST(WeightsMeasurement, MatchingDescriptorsAreNearerThanOthers) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
  const std::pair<GrayImage, GrayImage> pairs[] = {{Picture(320, 240), Picture(320, 240, 5.0F)}};
  const MeasuredDistances measured = MeasureDistances(weights, {}, pairs, {.upright = true});
  EXPECT_GE(measured.num_pairs, 100U);
  const DistanceQuantiles& found = measured.quantiles;
  EXPECT_TRUE(std::ranges::is_sorted(found.matching));
  EXPECT_TRUE(std::ranges::is_sorted(found.nearest_wrong));
  EXPECT_LT(found.matching[2], found.nearest_wrong[2]);
}

TEST(WeightsMeasurement, RefusesTooLittle) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
  const GrayImage grey[] = {GrayImage(cv::Mat(100, 100, CV_8UC1, cv::Scalar(9)))};
  EXPECT_THROW(MeasureDistances(weights, grey, {}, {.upright = true}), InputError);
  EXPECT_THROW(MeasureDistances(weights, grey, {}, {.upright = false}), InputError);
  EXPECT_THROW(MeasureRangesOnImages(weights, grey, 4, 0), InputError);
}

}  // namespace
}  // namespace lift_slam
