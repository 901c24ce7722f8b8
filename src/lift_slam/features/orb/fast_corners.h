#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lift_slam/image/image.h"

namespace lift_slam {

// A corner on whole pixels of one pyramid level.
struct Corner {
  static constexpr int kMaxPosition = 32767;

  std::int16_t x = 0, y = 0;
  std::uint8_t score = 0;  // grey levels
};

// The FAST-9 score (Rosten and Drummond, 2006) of every pixel at least `border` from the edge: the
// largest s such that 9 contiguous pixels of the 16 on the circle of radius 3 are all brighter, or
// all darker, than the centre by at least s. A pixel is a FAST corner of threshold t when s > t.
class FastScoreMap {
 public:
  // The scores of the pixels at least border - 1 from the edge; border >= 16. Keeps its memory
  // from image to image.
  void Compute(const GrayImage& image, int border);

  std::uint8_t Score(int x, int y) const { return row(y)[x]; }
  // Local maxima (3 x 3; of equal neighbours the first in raster order) with score > threshold at
  // least `border` from the edge, in raster order.
  void FindCorners(int threshold, std::vector<Corner>& corners) const;

 private:
  const std::uint8_t* row(int y) const {
    return scores_.data() + static_cast<std::size_t>(y) * stride_;
  }
  std::uint8_t* row(int y) { return scores_.data() + static_cast<std::size_t>(y) * stride_; }

  int width_ = 0, height_ = 0, border_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint8_t> scores_;
};

}  // namespace lift_slam
