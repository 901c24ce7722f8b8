#pragma once

#include <ceres/autodiff_cost_function.h>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/optimization/cost_functions/sim3_parameters.h"
#include "lift_slam/optimization/min_depth.h"

namespace lift_slam {

// Residuals: inverse_sigma (Project(x) - pixel), 2, of a point that a similarity brings into the
// camera. kForward: x = S * point with S = change * base; kBackward: x = S^-1 * point. A point
// behind the camera has constant residuals of 100 sigmas, which make a solver take back the step; a
// scale changed by more than exp(20) cannot be evaluated, to the same effect.
// Parameter block: [0] change of the similarity (7), see sim3_parameters.h.
class Sim3ReprojectionCost {
 public:
  enum class Direction { kForward, kBackward };

  Sim3ReprojectionCost(const PinholeIntrinsics& intrinsics, const Sim3d& base, Direction direction,
                       const Eigen::Vector3d& point, const Eigen::Vector2d& pixel,
                       double inverse_sigma)
      : intrinsics_(intrinsics),
        base_(base),
        direction_(direction),
        point_(point),
        pixel_(pixel),
        inverse_sigma_(inverse_sigma) {}

  static ceres::CostFunction* Create(const Sim3ReprojectionCost& cost) {
    return new ceres::AutoDiffCostFunction<Sim3ReprojectionCost, 2, kSim3Parameters>(
        new Sim3ReprojectionCost(cost));
  }

  template <class T>
  bool operator()(const T* parameters, T* residuals) const {
    if (!IsScaleNear(parameters[kLogScaleParameter])) return false;
    const GenericSim3<T> similarity = Sim3FromParameters(parameters) * Cast<T>(base_);
    const Eigen::Matrix<T, 3, 1> point = point_.cast<T>();
    const Eigen::Matrix<T, 3, 1> x =
        direction_ == Direction::kForward ? similarity * point : similarity.Inverse() * point;
    if (!(x.z() > T(kMinDepth))) {
      residuals[0] = residuals[1] = T(kSim3BehindSigmas);
      return true;
    }
    residuals[0] =
        (x.x() / x.z() * intrinsics_.fx + (intrinsics_.cx - pixel_.x())) * inverse_sigma_;
    residuals[1] =
        (x.y() / x.z() * intrinsics_.fy + (intrinsics_.cy - pixel_.y())) * inverse_sigma_;
    return true;
  }

 private:
  PinholeIntrinsics intrinsics_;
  Sim3d base_;
  Direction direction_;
  Eigen::Vector3d point_;
  Eigen::Vector2d pixel_;
  double inverse_sigma_;
};

}  // namespace lift_slam
