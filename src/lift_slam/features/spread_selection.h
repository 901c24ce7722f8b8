#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lift_slam {

// A rectangle of pixels, min included and max excluded.
struct PixelRectangle {
  int min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

struct ScoredPoint {
  float x = 0.0F, y = 0.0F;
  float score = 0.0F;  // larger is stronger
};

// Picks points spread evenly over the area: a quad-tree is split, largest cells and then fullest
// cells first, until it has `count` leaves, and each leaf gives its strongest point (of equal ones
// the first in raster order, then in the order given). Returns at most `count` positions in
// `points`, in raster order of the points; all of them in the order given when there are no more
// than `count`. Points outside the area belong to the nearest cell.
std::vector<std::size_t> SelectSpread(const PixelRectangle& area, int count,
                                      std::span<const ScoredPoint> points);

}  // namespace lift_slam
