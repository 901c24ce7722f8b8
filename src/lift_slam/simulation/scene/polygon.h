#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace lift_slam {

// A simple, roughly flat polygon as triangles of corner numbers, in the polygon's own sense of
// rotation: a fan when convex, else by cutting ears. Degenerate polygons (no area) give a fan.
std::vector<std::array<int, 3>> TriangulatePolygon(std::span<const Eigen::Vector3f> corners);

}  // namespace lift_slam
