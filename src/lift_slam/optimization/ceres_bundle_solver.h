#pragma once

#include <ceres/evaluation_callback.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/optimization/bundle_round.h"
#include "lift_slam/optimization/cost_functions/reprojection_cost.h"

namespace lift_slam {

// A bundle adjustment as a ceres::Problem: one residual block an observation, points eliminated
// first. Works on copies of poses and points.
class CeresBundleSolver : public ceres::EvaluationCallback {
 public:
  // `problem` must outlive this. Its indices are in range.
  explicit CeresBundleSolver(const BundleProblem& problem);
  ~CeresBundleSolver() override;
  CeresBundleSolver(const CeresBundleSolver&) = delete;
  CeresBundleSolver& operator=(const CeresBundleSolver&) = delete;

  // Goes on from the present poses and points with the observations marked in `is_active`.
  BundleRoundSummary Solve(const std::vector<char>& is_active, const BundleRoundOptions& options);

  Rigid3d CamFromWorld(std::size_t camera) const { return cameras_[camera].CamFromWorld(); }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  // Called by Ceres before it evaluates the residuals.
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

 private:
  class Loss;

  void AddObservation(const BundleObservation& observation, bool is_camera_fixed);

  std::vector<CameraBlock> cameras_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<ReprojectionTerm> terms_;  // one an observation, as costs_
  std::vector<std::unique_ptr<ceres::CostFunction>> costs_;
  std::unique_ptr<Loss> loss_;
  // Ceres walks its groups by address; within points_ and cameras_ that is the order of indices.
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  std::unique_ptr<ceres::Problem> ceres_problem_;  // last: it refers to all the others
};

}  // namespace lift_slam
