#include "lift_slam/simulation/motion/periodic_spline.h"

#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// The uniform cubic basis and its derivatives by the share t of the way between two knots.
Eigen::Vector4d Basis(double t) {
  const double s = 1.0 - t;
  return Eigen::Vector4d(s * s * s, 3.0 * t * t * t - 6.0 * t * t + 4.0,
                         3.0 * s * s * s - 6.0 * s * s + 4.0, t * t * t) /
         6.0;
}

Eigen::Vector4d BasisDerivative(double t) {
  const double s = 1.0 - t;
  return Eigen::Vector4d(-s * s, 3.0 * t * t - 4.0 * t, -3.0 * s * s + 4.0 * s, t * t) / 2.0;
}

Eigen::Vector4d BasisSecondDerivative(double t) {
  return {1.0 - t, 3.0 * t - 2.0, 1.0 - 3.0 * t, t};
}

}  // namespace

PeriodicSpline::PeriodicSpline(std::vector<Eigen::Vector3d> control_points, double spacing)
    : control_points_(std::move(control_points)), spacing_(spacing) {
  LIFT_SLAM_CHECK(control_points_.size() >= 4 && spacing > 0.0, "{} control points, spacing {}",
                  control_points_.size(), spacing);
}

Eigen::Vector3d PeriodicSpline::Blend(double x, Eigen::Vector4d (*weights)(double share)) const {
  const double knots = x / spacing_;
  const double whole = std::floor(knots);
  const auto size = static_cast<std::int64_t>(control_points_.size());
  const std::int64_t first = static_cast<std::int64_t>(whole) - 1;
  const Eigen::Vector4d weight = weights(knots - whole);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const std::int64_t at = ((first + i) % size + size) % size;
    sum += weight[i] * control_points_[static_cast<std::size_t>(at)];
  }
  return sum;
}

Eigen::Vector3d PeriodicSpline::Value(double x) const { return Blend(x, Basis); }

Eigen::Vector3d PeriodicSpline::Derivative(double x) const {
  return Blend(x, BasisDerivative) / spacing_;
}

Eigen::Vector3d PeriodicSpline::SecondDerivative(double x) const {
  return Blend(x, BasisSecondDerivative) / (spacing_ * spacing_);
}

std::vector<double> GaussianKernel(double standard_deviation, double spacing) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3.0 * standard_deviation / spacing)));
  std::vector<double> kernel;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    const double sigmas = standard_deviation > 0.0 ? i * spacing / standard_deviation : i * 1e3;
    kernel.push_back(std::exp(-0.5 * sigmas * sigmas));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

}  // namespace lift_slam
