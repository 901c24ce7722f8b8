#include "lift_slam/simulation/rendering/culling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace lift_slam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

// Half-spaces normal . (x - eye) + offset >= 0 whose intersection is the view.
using Planes = std::array<Vector4d, 6>;

Planes ViewPlanes(const PinholeView& view, const Eigen::Matrix3d& view_from_scene,
                  const DepthRange& range) {
  const PinholeIntrinsics& p = view.pinhole;
  const auto side = [&](const Vector3d& in_view) -> Vector4d {
    return (view_from_scene.transpose() * in_view).homogeneous() - Vector4d::UnitW();
  };
  Planes planes = {side({p.fx, 0.0, p.cx + 0.5}), side({-p.fx, 0.0, p.width - 0.5 - p.cx}),
                   side({0.0, p.fy, p.cy + 0.5}), side({0.0, -p.fy, p.height - 0.5 - p.cy}),
                   side({0.0, 0.0, 1.0}),         side({0.0, 0.0, -1.0})};
  planes[4].w() = -range.near_m;
  planes[5].w() = range.far_m;
  return planes;
}

// False only when the box lies entirely outside one of the planes.
bool MayBeSeen(const Planes& planes, const Vector3d& center, const Vector3d& half) {
  return std::all_of(planes.begin(), planes.end(), [&](const Vector4d& plane) {
    const Vector3d normal = plane.head<3>();
    return normal.dot(center) + plane.w() + normal.cwiseAbs().dot(half) >= 0.0;
  });
}

// 0 up to 16 m from the camera, then one more for each doubling.
int Shell(const Vector3d& center, const Vector3d& half) {
  const double distance_m = (center.cwiseAbs() - half).cwiseMax(0.0).norm();
  return distance_m <= 16.0 ? 0 : 1 + static_cast<int>(std::log2(distance_m / 16.0));
}

}  // namespace

std::vector<int> VisibleChunks(const ChunkedScene& scene, const PinholeView& view,
                               const ViewPose& pose, const DepthRange& range) {
  const Planes planes = ViewPlanes(view, view.view_from_cam * pose.cam_from_scene, range);
  std::vector<std::tuple<bool, int, int, int>> seen;  // is alpha-tested, shell, appearance, chunk
  for (std::size_t i = 0; i < scene.chunks.size(); ++i) {
    const Chunk& chunk = scene.chunks[i];
    const Vector3d center = chunk.box.center().cast<double>() - pose.eye;
    const Vector3d half = 0.5 * chunk.box.sizes().cast<double>();
    if (!MayBeSeen(planes, center, half)) continue;
    const auto& look = scene.appearances[static_cast<std::size_t>(chunk.appearance)];
    seen.emplace_back(look.is_alpha_tested, Shell(center, half), chunk.appearance,
                      static_cast<int>(i));
  }
  std::sort(seen.begin(), seen.end());
  std::vector<int> order;
  order.reserve(seen.size());
  for (const auto& entry : seen) order.push_back(std::get<3>(entry));
  return order;
}

}  // namespace lift_slam
