#include "lift_slam/simulation/scene/polygon.h"

#include <Eigen/Geometry>

namespace lift_slam {
namespace {

using Corners = std::span<const Eigen::Vector3f>;

// Newell's normal; its length is twice the area.
Eigen::Vector3f PolygonNormal(Corners corners) {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  return normal;
}

// Positive when the corner b turns in the polygon's sense.
float Turn(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
           const Eigen::Vector3f& normal) {
  return (b - a).cross(c - b).dot(normal);
}

bool Inside(const Eigen::Vector3f& point, const std::array<Eigen::Vector3f, 3>& triangle,
            const Eigen::Vector3f& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (Turn(triangle[i], triangle[(i + 1) % 3], point, normal) < 0.0F) return false;
  }
  return true;
}

bool IsEar(Corners corners, const std::vector<int>& left, std::size_t at,
           const Eigen::Vector3f& normal) {
  const std::size_t size = left.size();
  const auto corner = [&](std::size_t i) { return corners[static_cast<std::size_t>(left[i])]; };
  const std::size_t before = (at + size - 1) % size;
  const std::size_t after = (at + 1) % size;
  const std::array<Eigen::Vector3f, 3> ear = {corner(before), corner(at), corner(after)};
  if (Turn(ear[0], ear[1], ear[2], normal) <= 0.0F) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (i == before || i == at || i == after) continue;
    if (Inside(corner(i), ear, normal)) return false;
  }
  return true;
}

bool IsConvex(Corners corners, const Eigen::Vector3f& normal) {
  const std::size_t size = corners.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (Turn(corners[i], corners[(i + 1) % size], corners[(i + 2) % size], normal) < 0.0F) {
      return false;
    }
  }
  return true;
}

void AppendFan(const std::vector<int>& left, std::vector<std::array<int, 3>>& triangles) {
  for (std::size_t i = 2; i < left.size(); ++i) {
    triangles.push_back({left[0], left[i - 1], left[i]});
  }
}

}  // namespace

std::vector<std::array<int, 3>> TriangulatePolygon(Corners corners) {
  std::vector<int> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  std::vector<std::array<int, 3>> triangles;
  const Eigen::Vector3f normal = PolygonNormal(corners);
  bool found = corners.size() > 3 && !IsConvex(corners, normal);
  while (found && left.size() > 3) {
    found = false;
    for (std::size_t at = 0; at < left.size() && !found; ++at) {
      if (!IsEar(corners, left, at, normal)) continue;
      const std::size_t size = left.size();
      triangles.push_back({left[(at + size - 1) % size], left[at], left[(at + 1) % size]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      found = true;
    }
  }
  AppendFan(left, triangles);
  return triangles;
}

}  // namespace lift_slam
