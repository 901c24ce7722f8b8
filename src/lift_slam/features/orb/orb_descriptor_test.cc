#include "lift_slam/features/orb/orb_descriptor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "lift_slam/features/orb/noise_image_for_test.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// cv::ORB's descriptors of the same corners; with the default edge threshold of 31 it would drop
// those near the edge.
cv::Mat OpenCvDescriptors(const cv::Mat& image, const std::vector<OrientedCorner>& corners) {
  std::vector<cv::KeyPoint> keypoints;
  for (const OrientedCorner& c : corners) {
    keypoints.emplace_back(static_cast<float>(c.x), static_cast<float>(c.y), 31.0F,
                           c.angle_rad * (180.0F / std::numbers::pi_v<float>));
    keypoints.back().octave = 0;
  }
  cv::Mat rows;
  cv::ORB::create(500, 1.2F, 8, /*edgeThreshold=*/19)->compute(image, keypoints, rows);
  return rows;
}

std::vector<OrientedCorner> RandomCorners(int width, int height, int count) {
  Random random(9);
  std::vector<OrientedCorner> corners;
  for (int i = 0; i < count; ++i) {
    constexpr int kBorder = OrbDescriptor::kBorder;
    corners.push_back({random.UniformInt(kBorder, width - 1 - kBorder),
                       random.UniformInt(kBorder, height - 1 - kBorder),
                       static_cast<float>(random.Uniform(-std::numbers::pi, std::numbers::pi))});
  }
  return corners;
}

TEST(OrbDescriptor, EqualsOpenCvsBitForBit) {
  OrbDescriptor descriptor;  // one for all sizes
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(39, 39), cv::Size(301, 90)}) {
    const cv::Mat image = NoiseImage(size.width, size.height, 7);
    const std::vector<OrientedCorner> corners = RandomCorners(size.width, size.height, 1500);
    const cv::Mat expected = OpenCvDescriptors(image, corners);
    ASSERT_EQ(expected.rows, 1500);
    std::vector<std::byte> rows(corners.size() * OrbDescriptor::kBytes);
    descriptor.Describe(GrayImage(image), corners, rows.data());
    EXPECT_TRUE(std::equal(rows.begin(), rows.end(), expected.ptr<std::byte>())) << size;
  }
}

TEST(OrbDescriptor, PatternStaysWithinItsReach) {
  const OrbPattern& pattern = OpenCvOrbPattern();
  for (std::size_t i = 0; i < OrbPattern::kBits; ++i) {
    const float reach = std::max({std::abs(pattern.first_x[i]), std::abs(pattern.first_y[i]),
                                  std::abs(pattern.second_x[i]), std::abs(pattern.second_y[i])});
    EXPECT_LE(reach, 13.0F);
  }
}

}  // namespace
}  // namespace lift_slam
