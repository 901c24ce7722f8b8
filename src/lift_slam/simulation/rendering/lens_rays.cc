#include "lift_slam/simulation/rendering/lens_rays.h"

#include <cmath>

namespace lift_slam {

using Eigen::Vector3d;

LensRays::LensRays(const Camera& camera)
    : width_(camera.pinhole.width), height_(camera.pinhole.height) {
  rays_.reserve(std::size_t(width_ + 2) * std::size_t(height_ + 2));
  for (int y = -1; y <= height_; ++y) {
    for (int x = -1; x <= width_; ++x) {
      rays_.push_back(camera.Unproject({x, y}).value_or(Vector3d::Zero()));
    }
  }
}

std::optional<Vector3d> LensRays::At(int x, int y) const {
  const auto index = std::size_t(y + 1) * std::size_t(width_ + 2) + std::size_t(x + 1);
  const Vector3d& ray = rays_[index];
  if (ray.isZero()) return std::nullopt;
  return ray;
}

std::optional<Vector3d> LensRays::Between(double x, double y) const {
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const auto a = At(left, top), b = At(left + 1, top);
  const auto c = At(left, top + 1), d = At(left + 1, top + 1);
  if (!a || !b || !c || !d) return std::nullopt;
  const double right_share = x - left;
  const double bottom_share = y - top;
  const Vector3d upper = (1.0 - right_share) * *a + right_share * *b;
  const Vector3d lower = (1.0 - right_share) * *c + right_share * *d;
  return ((1.0 - bottom_share) * upper + bottom_share * lower).normalized();
}

}  // namespace lift_slam
