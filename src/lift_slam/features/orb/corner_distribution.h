#pragma once

#include <vector>

#include "lift_slam/features/orb/fast_corners.h"
#include "lift_slam/features/spread_selection.h"

namespace lift_slam {

// Keeps, in each cell of about cell_size_px, only the corners with score > threshold if the cell
// has one, and all of them otherwise. Keeps the order.
void DropWeakCorners(const PixelRectangle& area, int cell_size_px, int threshold,
                     std::vector<Corner>& corners);

// SelectSpread: at most `count` corners, in raster order.
std::vector<Corner> SpreadCorners(const PixelRectangle& area, int count,
                                  std::vector<Corner> corners);

}  // namespace lift_slam
