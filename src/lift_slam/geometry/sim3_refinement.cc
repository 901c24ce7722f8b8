#include "lift_slam/geometry/sim3_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lift_slam/geometry/epipolar.h"

namespace lift_slam {
namespace {

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Matrix37 = Eigen::Matrix<double, 3, 7>;

struct NormalEquations {
  Matrix7 hessian = Matrix7::Zero();
  Vector7 gradient = Vector7::Zero();
  double cost = 0.0;  // sum of squared errors, each at most the limit
};

// The parameters are a change of camera 1's frame, x1' = e^l Exp(w) x1 + d, in the order (w, d, l).
class Sim3Refiner {
 public:
  Sim3Refiner(std::span<const Sim3Match> matches, double focal_length1_px, double focal_length2_px,
              ScaleFit scale_fit, double max_squared_error)
      : matches_(matches),
        focal_length1_px_(focal_length1_px),
        focal_length2_px_(focal_length2_px),
        scale_fit_(scale_fit),
        max_squared_error_(max_squared_error) {}

  Sim3d Run(Sim3d similarity, int max_iterations) const {
    NormalEquations equations = Linearize(similarity);
    double damping = 1e-4;
    for (int iteration = 0; iteration < max_iterations && damping < 1e6; ++iteration) {
      const Sim3d candidate = Step(similarity, equations, damping);
      const NormalEquations next = Linearize(candidate);
      if (!(next.cost < equations.cost)) {
        damping *= 10.0;
        continue;
      }
      const bool converged = equations.cost - next.cost < 1e-8 * equations.cost;
      similarity = candidate;
      equations = next;
      damping = std::max(damping * 0.1, 1e-9);
      if (converged) break;
    }
    return similarity;
  }

 private:
  NormalEquations Linearize(const Sim3d& cam1_from_cam2) const {
    NormalEquations equations;
    const Sim3d cam2_from_cam1 = Inverse(cam1_from_cam2);
    const Eigen::Matrix3d scaled_rotation =
        cam2_from_cam1.scale * cam2_from_cam1.rotation.toRotationMatrix();
    for (const Sim3Match& match : matches_) {
      // d x1 / d(w, d, l) = [-[x1]x, I, x1]
      const Eigen::Vector3d x1 = cam1_from_cam2 * match.point_in_cam2;
      Add(x1, match.normalized1, focal_length1_px_ / match.sigma1_px, ByChange(x1), equations);
      // x2 = S^-1 change^-1 point: the change the other way round, brought into camera 2.
      const Eigen::Vector3d x2 = cam2_from_cam1 * match.point_in_cam1;
      Add(x2, match.normalized2, focal_length2_px_ / match.sigma2_px,
          -scaled_rotation * ByChange(match.point_in_cam1), equations);
    }
    if (scale_fit_ == ScaleFit::kFixed) {
      equations.hessian.row(6).setZero();
      equations.hessian.col(6).setZero();
      equations.hessian(6, 6) = 1.0;
      equations.gradient(6) = 0.0;
    }
    return equations;
  }

  static Matrix37 ByChange(const Eigen::Vector3d& x) {
    Matrix37 jacobian;
    jacobian << -CrossMatrix(x), Eigen::Matrix3d::Identity(), x;
    return jacobian;
  }

  void Add(const Eigen::Vector3d& x, const Eigen::Vector2d& normalized, double pixels_per_sigma,
           const Matrix37& x_by_change, NormalEquations& equations) const {
    const Eigen::Vector2d residual = pixels_per_sigma * (x.head<2>() / x.z() - normalized);
    if (!(x.z() > 0.0) || !(residual.squaredNorm() < max_squared_error_)) {
      equations.cost += max_squared_error_;
      return;
    }
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1.0, 0.0, -x.x() / x.z(), 0.0, 1.0, -x.y() / x.z();
    const Eigen::Matrix<double, 2, 7> jacobian =
        (pixels_per_sigma / x.z()) * by_point * x_by_change;
    equations.hessian.noalias() += jacobian.transpose() * jacobian;
    equations.gradient.noalias() += jacobian.transpose() * residual;
    equations.cost += residual.squaredNorm();
  }

  static Sim3d Step(const Sim3d& similarity, const NormalEquations& equations, double damping) {
    Matrix7 damped = equations.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector7 step = -damped.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return similarity;
    const double angle = step.head<3>().norm();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    if (angle > 0.0) rotation = Eigen::AngleAxisd(angle, step.head<3>() / angle);
    return Sim3d(std::exp(step(6)), rotation, step.segment<3>(3)) * similarity;
  }

  std::span<const Sim3Match> matches_;
  double focal_length1_px_, focal_length2_px_;
  ScaleFit scale_fit_;
  double max_squared_error_;
};

}  // namespace

Sim3d RefineSim3(std::span<const Sim3Match> matches, double focal_length1_px,
                 double focal_length2_px, const Sim3d& cam1_from_cam2, ScaleFit scale_fit,
                 double max_squared_error, int max_iterations) {
  return Sim3Refiner(matches, focal_length1_px, focal_length2_px, scale_fit, max_squared_error)
      .Run(cam1_from_cam2, max_iterations);
}

}  // namespace lift_slam
