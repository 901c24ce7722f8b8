#include "lift_slam/optimization/pose_optimization.h"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lift_slam/optimization/cost_functions/pose_cost.h"
#include "lift_slam/optimization/min_depth.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr int kMinInliers = 3;  // points that fix the 6 parameters of a pose

// Weighted squared error; infinite when the point is not in front of the camera.
double SquaredError(const PinholeIntrinsics& intrinsics, const Eigen::Matrix3d& rotation,
                    const Eigen::Vector3d& translation, const PoseObservation& observation) {
  const Eigen::Vector3d x_in_cam = rotation * observation.point_in_world + translation;
  if (!(x_in_cam.z() > kMinDepth)) return std::numeric_limits<double>::infinity();
  return observation.inverse_variance *
         (intrinsics.Project(x_in_cam) - observation.pixel).squaredNorm();
}

// Marks the observations whose error is at most `limit`; returns their number.
int Classify(const PinholeIntrinsics& intrinsics, const Rigid3d& cam_from_world,
             std::span<const PoseObservation> observations, double limit,
             std::vector<char>& is_inlier) {
  const Eigen::Matrix3d rotation = cam_from_world.RotationMatrix();
  int count = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    is_inlier[i] =
        SquaredError(intrinsics, rotation, cam_from_world.translation, observations[i]) <= limit;
    count += is_inlier[i];
  }
  return count;
}

void Gather(std::span<const PoseObservation> observations, const std::vector<char>& is_used,
            PoseObservationArrays& arrays) {
  arrays.Clear();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (is_used[i]) arrays.Add(observations[i]);
  }
  arrays.Pad();
}

Rigid3d SolveRound(const PinholeIntrinsics& intrinsics, const Rigid3d& cam_from_world,
                   const PoseObservationArrays& arrays, bool is_robust, const CenterPrior& prior,
                   const PoseOptimizationOptions& options) {
  const double huber_width =
      is_robust ? std::sqrt(options.max_squared_error) : std::numeric_limits<double>::infinity();
  const PoseCost cost(intrinsics, cam_from_world, huber_width, arrays, prior);
  ceres::TinySolver<PoseCost> solver;
  solver.options.max_num_iterations = options.iterations_per_round + 1;  // it counts from 1
  solver.options.function_tolerance = options.min_change;
  Eigen::Matrix<double, 6, 1> change = Eigen::Matrix<double, 6, 1>::Zero();
  solver.Solve(cost, &change);
  return cost.CamFromWorld(change);
}

// The squared error that makes an outlier after this round.
double OutlierLimit(const PoseOptimizationOptions& options, int round) {
  const int last_wide = std::min(options.robust_rounds, options.rounds) - 1;
  const int earlier = std::max(0, last_wide - round);
  return options.max_squared_error * std::pow(options.limit_factor, earlier);
}

}  // namespace

PoseOptimizationResult OptimizePose(const PinholeIntrinsics& intrinsics,
                                    const Rigid3d& initial_cam_from_world,
                                    std::span<const PoseObservation> observations,
                                    const PoseOptimizationOptions& options,
                                    const CenterPrior& prior) {
  LIFT_SLAM_CHECK(options.rounds >= 1 && options.iterations_per_round >= 1,
                  "{} rounds of {} iterations", options.rounds, options.iterations_per_round);
  PoseOptimizationResult result;
  result.cam_from_world = initial_cam_from_world;
  result.is_inlier.resize(observations.size());
  // The first round uses all that can be seen at all.
  int num_used = Classify(intrinsics, initial_cam_from_world, observations,
                          std::numeric_limits<double>::max(), result.is_inlier);
  PoseObservationArrays arrays;
  for (int round = 0; round < options.rounds && num_used >= kMinInliers; ++round) {
    Gather(observations, result.is_inlier, arrays);
    result.cam_from_world = SolveRound(intrinsics, result.cam_from_world, arrays,
                                       round < options.robust_rounds, prior, options);
    num_used = Classify(intrinsics, result.cam_from_world, observations,
                        OutlierLimit(options, round), result.is_inlier);
  }
  if (num_used < kMinInliers) {
    result.cam_from_world = initial_cam_from_world;
    num_used = Classify(intrinsics, initial_cam_from_world, observations, options.max_squared_error,
                        result.is_inlier);
  }
  result.num_inliers = num_used;
  return result;
}

}  // namespace lift_slam
