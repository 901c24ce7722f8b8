#pragma once

#include <vector>

#include "lift_slam/features/orb/fast_corners.h"

namespace lift_slam {

// A rectangle of pixels, min included and max excluded.
struct PixelRectangle {
  int min_x = 0, min_y = 0, max_x = 0, max_y = 0;
};

// Keeps, in each cell of about cell_size_px, only the corners with score > threshold if the cell
// has one, and all of them otherwise. Keeps the order.
void DropWeakCorners(const PixelRectangle& area, int cell_size_px, int threshold,
                     std::vector<Corner>& corners);

// Picks about `count` corners spread evenly over the area: a quad-tree is split, largest cells and
// then fullest cells first, until it has `count` leaves, and each leaf gives its strongest corner
// (of equal ones the first in raster order). Returns at most `count`, in raster order.
std::vector<Corner> SpreadCorners(const PixelRectangle& area, int count,
                                  std::vector<Corner> corners);

}  // namespace lift_slam
