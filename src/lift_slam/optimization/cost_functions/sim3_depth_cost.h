#pragma once

#include <ceres/autodiff_cost_function.h>

#include "lift_slam/optimization/cost_functions/sim3_parameters.h"
#include "lift_slam/optimization/min_depth.h"

namespace lift_slam {

// Residual: (log z(S * point) - log_depth) / sigma, 1, where S = change * base brings a point into
// the camera and z is its depth there: both maps must tell the same depth. It carries the scale
// where both cameras stand at one place, and every scale gives the same images. Points behind the
// camera and scales far astray as in Sim3ReprojectionCost.
// Parameter block: [0] change of the similarity (7), see sim3_parameters.h.
class Sim3DepthCost {
 public:
  Sim3DepthCost(const Sim3d& base, const Eigen::Vector3d& point, double log_depth,
                double inverse_sigma)
      : base_(base), point_(point), log_depth_(log_depth), inverse_sigma_(inverse_sigma) {}

  static ceres::CostFunction* Create(const Sim3DepthCost& cost) {
    return new ceres::AutoDiffCostFunction<Sim3DepthCost, 1, kSim3Parameters>(
        new Sim3DepthCost(cost));
  }

  template <class T>
  bool operator()(const T* parameters, T* residuals) const {
    using std::log;
    if (!IsScaleNear(parameters[kLogScaleParameter])) return false;
    const Eigen::Matrix<T, 3, 1> point = point_.cast<T>();
    const T depth = (Sim3FromParameters(parameters) * Cast<T>(base_) * point).z();
    residuals[0] =
        depth > T(kMinDepth) ? T((log(depth) - log_depth_) * inverse_sigma_) : T(kSim3BehindSigmas);
    return true;
  }

 private:
  Sim3d base_;
  Eigen::Vector3d point_;
  double log_depth_, inverse_sigma_;
};

}  // namespace lift_slam
