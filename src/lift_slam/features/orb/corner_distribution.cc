#include "lift_slam/features/orb/corner_distribution.h"

#include <algorithm>
#include <cstdint>

namespace lift_slam {

void DropWeakCorners(const PixelRectangle& area, int cell_size_px, int threshold,
                     std::vector<Corner>& corners) {
  const int columns = std::max(1, (area.max_x - area.min_x) / cell_size_px);
  const int rows = std::max(1, (area.max_y - area.min_y) / cell_size_px);
  const auto cell_of = [&](const Corner& corner) {
    const int column = (corner.x - area.min_x) * columns / (area.max_x - area.min_x);
    const int row = (corner.y - area.min_y) * rows / (area.max_y - area.min_y);
    return static_cast<std::size_t>(row * columns + column);
  };
  std::vector<std::uint8_t> has_strong(static_cast<std::size_t>(rows * columns), 0);
  for (const Corner& corner : corners) {
    if (corner.score > threshold) has_strong[cell_of(corner)] = 1;
  }
  std::erase_if(corners, [&](const Corner& corner) {
    return corner.score <= threshold && has_strong[cell_of(corner)] != 0;
  });
}

std::vector<Corner> SpreadCorners(const PixelRectangle& area, int count,
                                  std::vector<Corner> corners) {
  if (count <= 0) return {};
  if (corners.size() <= static_cast<std::size_t>(count)) return corners;
  std::vector<ScoredPoint> points;
  points.reserve(corners.size());
  for (const Corner& corner : corners) {
    points.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y),
                      static_cast<float>(corner.score)});
  }
  std::vector<Corner> selected;
  for (const std::size_t i : SelectSpread(area, count, points)) selected.push_back(corners[i]);
  return selected;
}

}  // namespace lift_slam
