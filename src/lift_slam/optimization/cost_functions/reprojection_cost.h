#pragma once

#include <ceres/cost_function.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// Squared error over variance that an observation counts with when its point is behind the camera.
inline constexpr double kBehindSquaredError = 2.0e4;

// A free camera of a bundle adjustment. Its parameter block is a change [w (3), d (3)] of a base
// pose, x_in_cam = Exp(w) (base_cam_from_world * x_in_world) + d, so that it has no more
// parameters than degrees of freedom and needs no manifold. All observations of the camera share
// what depends on the block alone; Update() computes it once an evaluation
// (ceres::EvaluationCallback).
class CameraBlock {
 public:
  explicit CameraBlock(const Rigid3d& base_cam_from_world);

  double* parameters() { return parameters_.data(); }
  const double* parameters() const { return parameters_.data(); }
  void Update();  // after a change of the parameters
  Rigid3d CamFromWorld() const;

  // As of the last Update():
  const Eigen::Matrix3d& rotation() const { return rotation_; }            // Exp(w) base rotation
  const Eigen::Vector3d& translation() const { return translation_; }      // of cam_from_world
  const Eigen::Vector3d& shift() const { return shift_; }                  // d
  const Eigen::Matrix3d& left_jacobian() const { return left_jacobian_; }  // of w

 private:
  Rigid3d base_cam_from_world_;
  Eigen::Matrix<double, 6, 1> parameters_ = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_;
  Eigen::Vector3d shift_;
  Eigen::Matrix3d left_jacobian_;
};

// One observation: a point and the pixel where a camera sees it.
struct ReprojectionTerm {
  PinholeIntrinsics intrinsics;
  Eigen::Vector2d pixel;
  double inverse_sigma = 1.0;  // 1 / px
  bool is_active = true;       // when false the residuals are 0
};

// Residuals: inverse_sigma (Project(x_in_cam) - pixel), 2. A point behind the camera has
// constant residuals of squared norm kBehindSquaredError instead, which make a solver take back the
// step. Parameter blocks: [0] point in world (3), [1] change of the camera's pose (6), see
// CameraBlock.
class ReprojectionCost final : public ceres::SizedCostFunction<2, 3, 6> {
 public:
  // Both must outlive this.
  ReprojectionCost(const ReprojectionTerm& term, const CameraBlock& camera)
      : term_(term), camera_(camera) {}
  static ReprojectionCost* Create(const ReprojectionTerm& term, const CameraBlock& camera) {
    return new ReprojectionCost(term, camera);
  }

  // Expects camera.Update() to have been called for parameters[1].
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const ReprojectionTerm& term_;
  const CameraBlock& camera_;
};

// The same for a camera that does not move.
// Parameter blocks: [0] point in world (3).
class FixedCameraReprojectionCost final : public ceres::SizedCostFunction<2, 3> {
 public:
  FixedCameraReprojectionCost(const ReprojectionTerm& term, const CameraBlock& camera)
      : term_(term), camera_(camera) {}
  static FixedCameraReprojectionCost* Create(const ReprojectionTerm& term,
                                             const CameraBlock& camera) {
    return new FixedCameraReprojectionCost(term, camera);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const ReprojectionTerm& term_;
  const CameraBlock& camera_;
};

}  // namespace lift_slam
