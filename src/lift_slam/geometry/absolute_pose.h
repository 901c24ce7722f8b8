#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// A world point and where an image shows it.
struct PointMatch {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector2d normalized = Eigen::Vector2d::Zero();  // x / z, y / z, undistorted
  double sigma_px = 1.0;                                 // standard deviation of each coordinate
};

struct AbsolutePoseOptions {
  int min_inliers = 12;           // fewer agree by chance
  double min_inlier_ratio = 0.1;  // of the matches
  int max_iterations = 500;       // RANSAC samples of three: enough for 20 percent inliers

  void Visit(OptionVisitor& visitor);
};

struct AbsolutePose {
  Rigid3d cam_from_world;
  std::vector<std::uint8_t> is_inlier;  // a match: 1 when its error is below the 95 percent limit
  int num_inliers = 0;
};

// Pose of a camera from matches with map points: P3P in RANSAC, every better sample refined on its
// inliers. Deterministic for a seed. `focal_length_px` turns sigma_px into normalised units.
// Nothing when too few matches agree on one pose.
std::optional<AbsolutePose> EstimateAbsolutePose(std::span<const PointMatch> matches,
                                                 double focal_length_px,
                                                 const AbsolutePoseOptions& options,
                                                 std::uint64_t seed);

// Minimises the squared reprojection errors in sigmas (6 degrees of freedom,
// Levenberg-Marquardt); errors above sqrt(max_squared_error) sigmas have no pull.
Rigid3d RefineAbsolutePose(std::span<const PointMatch> matches, double focal_length_px,
                           const Rigid3d& cam_from_world, double max_squared_error,
                           int max_iterations);

}  // namespace lift_slam
