#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/optimization/compressed_normal_equations.h"
#include "lift_slam/optimization/cost_functions/reprojection_cost.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {

// An observation of a bundle adjustment, beside the others of its point.
struct ReducedObservation {
  int camera = 0;        // index of its block
  int free_camera = -1;  // position among the free cameras; -1: fixed
  double u = 0.0, v = 0.0;
  double weight = 1.0;  // inverse variance
};

// The observations [begin, end) of a point.
struct ReducedPoint {
  int point = 0;
  int begin = 0, end = 0;
};

struct ReducedBundleOptions {
  PinholeIntrinsics intrinsics;
  double huber_width = 0.0;  // infinity: a plain sum
  double max_time_s = 0.0;   // later steps are refused; infinity: no limit
};

// Cost of the free cameras of a bundle adjustment with the points eliminated, for
// ceres::TinySolver.
// Parameters: for each free camera the change [w (3), d (3)] of its pose, see CameraBlock.
// Cost: 1/2 sum rho(e) over all observations as in PoseCost; a point behind a camera counts as an
// error of kBehindSquaredError.
// The points belong to the state of this object. A step of the cameras takes each point along by
// its own Gauss-Newton step given that of the cameras, so that both together are the step of the
// whole problem (Schur complement; Triggs et al., Bundle Adjustment, A Modern Synthesis, sec. 6.1);
// a point
// which that step makes worse makes a shorter one or stays. Residuals and Jacobian are those of
// compressed_normal_equations.h for the reduced camera system
//   S = H_cc - H_cp H_pp^-1 H_pc,  g = g_c - H_cp H_pp^-1 g_p.
// Relies on TinySolver asking for a Jacobian only at the start and at the trial just evaluated.
class ReducedBundleCost {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  // `cameras` are all cameras with their present poses, `free_cameras` the indices of those that
  // move. All references must outlive this.
  ReducedBundleCost(const ReducedBundleOptions& options, std::vector<CameraBlock>& cameras,
                    const std::vector<int>& free_cameras,
                    const std::vector<ReducedObservation>& observations,
                    const std::vector<ReducedPoint>& ranges, std::vector<Eigen::Vector3d>& points);

  int NumParameters() const { return 6 * static_cast<int>(free_cameras_.size()); }
  int NumResiduals() const { return NumParameters() + 1; }
  bool operator()(const double* parameters, double* residuals, double* jacobian) const;

  // Sets cameras and points to the solution with these parameters: the last ones that were given a
  // Jacobian, or the last trial.
  void Accept(const Eigen::VectorXd& parameters) const;
  // Normal equations of S and g at the present cameras and points.
  const NormalEquations<Eigen::Dynamic>& Linearize() const;

 private:
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  // What a step of the cameras needs to take a point along.
  struct PointSystem {
    Eigen::Matrix3d inverse_hessian;
    Eigen::Vector3d gradient;
    double loss = 0.0;
  };

  void SetCameras(const Eigen::VectorXd& parameters) const;
  void LinearizePoint(std::size_t range) const;
  void EliminatePoint(std::size_t range, const PointSystem& system) const;
  void ApplyRotationChain() const;
  // The sum of losses after the cameras have moved; moves trial_points_ along.
  double TrialSquaredNorm(const Eigen::VectorXd& parameters) const;
  // Sets the point's trial and returns its loss there.
  double MovePoint(std::size_t range, const Eigen::VectorXd& camera_steps) const;
  // The Gauss-Newton step of a point when the cameras move by `camera_steps` (tangent of the pose).
  Eigen::Vector3d PointStep(std::size_t range, const Eigen::VectorXd& camera_steps) const;
  double PointLoss(const ReducedPoint& range, const Eigen::Vector3d& point) const;

  ReducedBundleOptions options_;
  std::vector<CameraBlock>& cameras_;
  const std::vector<int>& free_cameras_;
  const std::vector<ReducedObservation>& observations_;
  const std::vector<ReducedPoint>& ranges_;
  std::vector<Eigen::Vector3d>& points_;
  Timer timer_;
  // TinySolver calls a const function; all that it changes is scratch of one solve.
  mutable std::vector<Eigen::Vector3d> trial_points_;
  mutable Eigen::VectorXd trial_parameters_;
  mutable Eigen::VectorXd linearized_parameters_;
  mutable std::vector<PointSystem> systems_;              // one a range
  mutable std::vector<Matrix36> point_camera_blocks_;     // H_pc, one an observation
  mutable std::vector<Eigen::Matrix3d> rotation_chains_;  // left Jacobians at the linearisation
  mutable NormalEquations<Eigen::Dynamic> equations_;
};

}  // namespace lift_slam
