#include "lift_slam/geometry/p3p.h"

#include <Eigen/Dense>
#include <cmath>

namespace lift_slam {
namespace {

constexpr int kNewtonSteps = 3;
// A root counts as real when its imaginary part is below this; Newton's method removes the rest.
constexpr double kMaxImaginary = 1e-4;
constexpr double kMinTriangle = 1e-12;

// The known squared side lengths of the triangle and the cosines between the rays. Names as in the
// paper: a is opposite point 1, alpha between rays 2 and 3.
struct Triangle {
  double a2 = 0.0, b2 = 0.0, c2 = 0.0;
  double cos_alpha = 0.0, cos_beta = 0.0, cos_gamma = 0.0;
};

// Real roots of p[4] x^4 + ... + p[0].
std::vector<double> RealRoots(const std::array<double, 5>& p) {
  std::vector<double> roots;
  if (!(std::abs(p[4]) > 1e-12)) return roots;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.bottomLeftCorner<3, 3>().setIdentity();
  for (int i = 0; i < 4; ++i) companion(i, 3) = -p[static_cast<std::size_t>(i)] / p[4];
  if (!companion.allFinite()) return roots;
  const Eigen::EigenSolver<Eigen::Matrix4d> solver(companion, /*computeEigenvectors=*/false);
  for (int i = 0; i < 4; ++i) {
    const auto root = solver.eigenvalues()[i];
    if (std::abs(root.imag()) < kMaxImaginary) roots.push_back(root.real());
  }
  return roots;
}

// The quartic in v = distance3 / distance1, eq. (9) of the paper.
std::array<double, 5> Quartic(const Triangle& t) {
  const double p = (t.a2 - t.c2) / t.b2;
  const double q = (t.a2 + t.c2) / t.b2;
  const double a = t.a2 / t.b2, c = t.c2 / t.b2;
  const double ca = t.cos_alpha, cb = t.cos_beta, cg = t.cos_gamma;
  std::array<double, 5> coefficients{};
  coefficients[4] = (p - 1) * (p - 1) - 4 * c * ca * ca;
  coefficients[3] = 4 * (p * (1 - p) * cb - (1 - q) * ca * cg + 2 * c * ca * ca * cb);
  coefficients[2] = 2 * (p * p - 1 + 2 * p * p * cb * cb + 2 * (1 - c) * ca * ca -
                         4 * q * ca * cb * cg + 2 * (1 - a) * cg * cg);
  coefficients[1] = 4 * (-p * (1 + p) * cb + 2 * a * cg * cg * cb - (1 - q) * ca * cg);
  coefficients[0] = (1 + p) * (1 + p) - 4 * a * cg * cg;
  return coefficients;
}

// Distances of the three points for a root v, eq. (8).
Eigen::Vector3d DistancesOf(const Triangle& t, double v) {
  const double p = (t.a2 - t.c2) / t.b2;
  const double u =
      ((p - 1) * v * v - 2 * p * t.cos_beta * v + 1 + p) / (2 * (t.cos_gamma - v * t.cos_alpha));
  const double first = std::sqrt(t.b2 / (1 + v * v - 2 * v * t.cos_beta));
  return {first, u * first, v * first};
}

// Newton's method on the three laws of cosines.
Eigen::Vector3d Polish(const Triangle& t, Eigen::Vector3d s) {
  for (int step = 0; step < kNewtonSteps; ++step) {
    const double s1 = s[0], s2 = s[1], s3 = s[2];
    const Eigen::Vector3d error(s2 * s2 + s3 * s3 - 2 * s2 * s3 * t.cos_alpha - t.a2,
                                s1 * s1 + s3 * s3 - 2 * s1 * s3 * t.cos_beta - t.b2,
                                s1 * s1 + s2 * s2 - 2 * s1 * s2 * t.cos_gamma - t.c2);
    Eigen::Matrix3d jacobian;
    jacobian << 0, s2 - s3 * t.cos_alpha, s3 - s2 * t.cos_alpha,  //
        s1 - s3 * t.cos_beta, 0, s3 - s1 * t.cos_beta,            //
        s1 - s2 * t.cos_gamma, s2 - s1 * t.cos_gamma, 0;
    const Eigen::Vector3d change = (2.0 * jacobian).partialPivLu().solve(error);
    if (!change.allFinite()) break;
    s -= change;
  }
  return s;
}

// Orthonormal axes of a triangle.
Eigen::Matrix3d AxesOf(const std::array<Eigen::Vector3d, 3>& points) {
  Eigen::Matrix3d axes;
  axes.col(0) = (points[1] - points[0]).normalized();
  axes.col(2) = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Triangle TriangleOf(const std::array<Eigen::Vector3d, 3>& points,
                    const std::array<Eigen::Vector3d, 3>& rays) {
  Triangle t;
  t.a2 = (points[1] - points[2]).squaredNorm();
  t.b2 = (points[0] - points[2]).squaredNorm();
  t.c2 = (points[0] - points[1]).squaredNorm();
  t.cos_alpha = rays[1].dot(rays[2]);
  t.cos_beta = rays[0].dot(rays[2]);
  t.cos_gamma = rays[0].dot(rays[1]);
  return t;
}

}  // namespace

std::vector<Rigid3d> SolveP3p(const std::array<Eigen::Vector3d, 3>& points_in_world,
                              const std::array<Eigen::Vector3d, 3>& rays_in_cam) {
  std::vector<Rigid3d> poses;
  const Triangle triangle = TriangleOf(points_in_world, rays_in_cam);
  const double area = (points_in_world[1] - points_in_world[0])
                          .cross(points_in_world[2] - points_in_world[0])
                          .squaredNorm();
  if (!(area > kMinTriangle * triangle.b2 * triangle.c2)) return poses;
  const Eigen::Matrix3d world_axes = AxesOf(points_in_world);
  for (const double v : RealRoots(Quartic(triangle))) {
    const Eigen::Vector3d distances = Polish(triangle, DistancesOf(triangle, v));
    if (!(distances.minCoeff() > 0.0) || !distances.allFinite()) continue;
    std::array<Eigen::Vector3d, 3> in_cam;
    for (std::size_t i = 0; i < 3; ++i) {
      in_cam[i] = distances[static_cast<Eigen::Index>(i)] * rays_in_cam[i];
    }
    const Eigen::Matrix3d rotation = AxesOf(in_cam) * world_axes.transpose();
    if (!rotation.allFinite()) continue;
    poses.emplace_back(rotation, in_cam[0] - rotation * points_in_world[0]);
  }
  return poses;
}

}  // namespace lift_slam
