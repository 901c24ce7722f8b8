#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/optimization/bundle_round.h"
#include "lift_slam/optimization/cost_functions/reduced_bundle_cost.h"

namespace lift_slam {

// A bundle adjustment of a few dozen free cameras: ceres::TinySolver over the cameras, points
// eliminated by ReducedBundleCost. Work grows with the cube of the free cameras. Works on copies
// of poses and points, on one thread.
class ReducedBundleSolver {
 public:
  // `problem` must outlive this. Its indices are in range and at least one camera is free.
  explicit ReducedBundleSolver(const BundleProblem& problem);

  // Goes on from the present poses and points with the observations marked in `is_active`.
  BundleRoundSummary Solve(const std::vector<char>& is_active, const BundleRoundOptions& options);

  Rigid3d CamFromWorld(std::size_t camera) const { return cameras_[camera].CamFromWorld(); }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  void GatherObservations(const std::vector<char>& is_active);

  const BundleProblem& problem_;
  std::vector<CameraBlock> cameras_;
  std::vector<int> free_cameras_;
  std::vector<int> free_index_;  // of each camera; -1: fixed
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> order_;  // observations by point, then by position among the free cameras
  std::vector<ReducedObservation> observations_;
  std::vector<ReducedPoint> ranges_;
};

}  // namespace lift_slam
