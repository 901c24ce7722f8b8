#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/optimization/compressed_normal_equations.h"
#include "lift_slam/optimization/pose_optimization.h"

namespace lift_slam {

// Observations as arrays of one quantity each, for evaluation four at a time; padded to a multiple
// of four with observations of weight 0.
class PoseObservationArrays {
 public:
  static constexpr int kLanes = 4;

  void Clear();
  void Add(const PoseObservation& observation);
  void Pad();

  std::vector<double> x, y, z;  // point in world
  std::vector<double> u, v;     // pixel
  std::vector<double> weight;   // inverse variance
};

// Cost of one camera pose for ceres::TinySolver.
// Parameters: [w (3), d (3)], a change of the base pose:
//   x_in_cam = Exp(w) (base_cam_from_world * x_in_world) + d.
// Cost: 1/2 sum rho(e_i), e_i = weight_i |Project(x_in_cam) - pixel_i|^2, with Huber's
// rho(e) = e for e <= huber_width^2, else 2 huber_width sqrt(e) - huber_width^2.
// A prior adds 1/2 inverse_variance |centre - center_in_world|^2, without a loss.
// Residuals and Jacobian are those of compressed_normal_equations.h. A pose that puts a point
// behind the camera has infinite cost.
class PoseCost {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = 7, NUM_PARAMETERS = 6 };

  // `observations` must outlive this and be padded. An infinite huber_width means a plain sum.
  PoseCost(const PinholeIntrinsics& intrinsics, const Rigid3d& base_cam_from_world,
           double huber_width, const PoseObservationArrays& observations,
           const CenterPrior& prior = {})
      : intrinsics_(intrinsics),
        base_cam_from_world_(base_cam_from_world),
        huber_width_(huber_width),
        observations_(observations),
        prior_(prior) {}

  // residuals: 7; jacobian: 7 x 6 column-major, or null.
  bool operator()(const double* parameters, double* residuals, double* jacobian) const;

  // The pose that the parameters stand for.
  Rigid3d CamFromWorld(const Eigen::Matrix<double, 6, 1>& parameters) const;
  // sum rho(e_i) and the prior's; infinity with a point behind the camera.
  double SquaredNorm(const Eigen::Matrix<double, 6, 1>& parameters) const;
  NormalEquations<6> Evaluate(const Eigen::Matrix<double, 6, 1>& parameters) const;

 private:
  PinholeIntrinsics intrinsics_;
  Rigid3d base_cam_from_world_;
  double huber_width_;
  const PoseObservationArrays& observations_;
  CenterPrior prior_;
};

}  // namespace lift_slam
