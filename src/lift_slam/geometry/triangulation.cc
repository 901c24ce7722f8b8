#include "lift_slam/geometry/triangulation.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

// Relative size of the homogeneous coordinate below which a point counts as infinitely far: 1e-9
// of the baseline's inverse.
constexpr double kMinHomogeneous = 1e-9;

// Eigenvector of the smallest eigenvalue: minimises sum |ray x (P X)|^2 over |X| = 1.
std::optional<Eigen::Vector3d> SolveHomogeneous(const Eigen::Matrix4d& normal_matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(normal_matrix);
  const Eigen::Vector4d solution = solver.eigenvectors().col(0);
  if (!(std::abs(solution.w()) > kMinHomogeneous)) return std::nullopt;
  return Eigen::Vector3d(solution.hnormalized());
}

// Adds P^T (I - r r^T) P: the squared sine of the angle between the ray r and P X, times |P X|^2.
void AddView(const Matrix34& projection, const Eigen::Vector2d& normalized,
             Eigen::Matrix4d& normal_matrix) {
  const Eigen::Vector3d ray = normalized.homogeneous().normalized();
  const Eigen::RowVector4d along = ray.transpose() * projection;
  normal_matrix.noalias() += projection.transpose() * projection;
  normal_matrix.noalias() -= along.transpose() * along;
}

}  // namespace

std::optional<Eigen::Vector3d> TriangulatePoint(std::span<const PointView> views) {
  LIFT_SLAM_CHECK(views.size() >= 2, "{} views", views.size());
  const Eigen::Vector3d origin = views[0].cam_from_world.TargetOriginInSource();
  double scale = 0.0;
  for (const PointView& view : views) {
    scale = std::max(scale, (view.cam_from_world * origin).norm());
  }
  if (!(scale > 0.0)) return std::nullopt;
  Eigen::Matrix4d normal_matrix = Eigen::Matrix4d::Zero();
  for (const PointView& view : views) {
    Matrix34 projection;
    projection << view.cam_from_world.RotationMatrix(), (view.cam_from_world * origin) / scale;
    AddView(projection, view.normalized, normal_matrix);
  }
  const auto relative = SolveHomogeneous(normal_matrix);
  if (!relative) return std::nullopt;
  return Eigen::Vector3d(origin + scale * *relative);
}

std::optional<Eigen::Vector3d> TriangulatePoint(const Rigid3d& cam2_from_cam1,
                                                const Eigen::Vector2d& normalized1,
                                                const Eigen::Vector2d& normalized2) {
  const std::array<PointView, 2> views{PointView{Rigid3d(), normalized1},
                                       PointView{cam2_from_cam1, normalized2}};
  return TriangulatePoint(views);
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double ParallaxAngle(const Eigen::Vector3d& centre1, const Eigen::Vector3d& centre2,
                     const Eigen::Vector3d& point) {
  return AngleBetween(point - centre1, point - centre2);
}

}  // namespace lift_slam
