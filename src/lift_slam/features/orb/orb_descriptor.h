#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lift_slam/features/orb/orb_pattern.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// A corner to describe, on whole pixels of a pyramid level.
struct OrientedCorner {
  int x = 0, y = 0;
  float angle_rad = 0.0F;
};

// Rotated BRIEF (ORB paper, sec. 4): 256 bits, the same as cv::ORB gives.
class OrbDescriptor {
 public:
  static constexpr int kBits = static_cast<int>(OrbPattern::kBits);
  static constexpr std::size_t kBytes = OrbPattern::kBits / 8;
  // Corners must be at least this far from the edge of their level: the pattern reaches 13 pixels
  // in x and in y, turned 18.4.
  static constexpr int kBorder = 19;

  OrbDescriptor();

  // Writes corners.size() * kBytes bytes, row i for corner i.
  void Describe(const GrayImage& level, std::span<const OrientedCorner> corners, std::byte* rows);

 private:
  cv::Mat Smooth(const cv::Mat& level);

  const OrbPattern* pattern_;
  cv::Mat kernel_;
  std::vector<std::uint8_t> memory_;  // of the smoothed level, kept from image to image
};

}  // namespace lift_slam
