#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "lift_slam/image/image.h"

namespace lift_slam {

// A corner to describe, on whole pixels of a pyramid level.
struct OrientedCorner {
  int x = 0, y = 0;
  float angle_rad = 0.0F;
};

// Rotated BRIEF (ORB paper, sec. 4), 256 bits with OpenCV's learned pattern.
class OrbDescriptor {
 public:
  static constexpr int kBits = 256;
  static constexpr std::size_t kBytes = kBits / 8;
  // Corners must be at least this far from the edge of their level.
  static constexpr int kBorder = 19;

  OrbDescriptor();
  ~OrbDescriptor();
  OrbDescriptor(OrbDescriptor&&) noexcept;

  // Writes corners.size() * kBytes bytes, row i for corner i.
  void Describe(const GrayImage& level, std::span<const OrientedCorner> corners,
                std::byte* rows) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lift_slam
