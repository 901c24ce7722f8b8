#pragma once

#include <ceres/autodiff_cost_function.h>

#include "lift_slam/optimization/cost_functions/sim3_parameters.h"

namespace lift_slam {

// How far two cameras are from a measured similarity between them. With
// E = measured_b_from_a * (b_from_a)^-1, the identity when they agree, the residuals (7) are
// weight * [angle-axis of E's rotation, E's translation / translation_unit, ln of E's scale].
// The state is kept as changes of the cameras' frames, so that no number in it grows with the
// distance from the world's origin: b_from_a = change_b * base_b_from_a * change_a^-1.
// Parameter blocks: [0] change of camera a (7), [1] change of camera b (7); see sim3_parameters.h.
class PoseGraphCost {
 public:
  PoseGraphCost(const Sim3d& measured_b_from_a, const Sim3d& base_b_from_a, double weight,
                double translation_unit)
      : measured_b_from_a_(measured_b_from_a),
        base_a_from_b_(Inverse(base_b_from_a)),
        weight_(weight),
        translation_weight_(weight / translation_unit) {}

  static ceres::CostFunction* Create(const PoseGraphCost& cost) {
    return new ceres::AutoDiffCostFunction<PoseGraphCost, kSim3Parameters, kSim3Parameters,
                                           kSim3Parameters>(new PoseGraphCost(cost));
  }

  template <class T>
  bool operator()(const T* change_a, const T* change_b, T* residuals) const {
    using std::log;
    const GenericSim3<T> a_from_b = Sim3FromParameters(change_a) * Cast<T>(base_a_from_b_) *
                                    Sim3FromParameters(change_b).Inverse();
    const GenericSim3<T> error = Cast<T>(measured_b_from_a_) * a_from_b;
    const T rotation[4] = {error.rotation.w(), error.rotation.x(), error.rotation.y(),
                           error.rotation.z()};
    ceres::QuaternionToAngleAxis(rotation, residuals);
    for (int i = 0; i < 3; ++i) {
      residuals[i] *= weight_;
      residuals[3 + i] = error.translation[i] * translation_weight_;
    }
    residuals[kLogScaleParameter] = log(error.scale) * weight_;
    return true;
  }

 private:
  Sim3d measured_b_from_a_, base_a_from_b_;
  double weight_, translation_weight_;
};

}  // namespace lift_slam
