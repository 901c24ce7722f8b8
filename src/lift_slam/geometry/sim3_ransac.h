#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lift_slam/geometry/alignment.h"
#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// One place seen by two cameras that do not share a scale: each has a map point of its own there,
// in its own frame and map units, and an image that shows it.
struct Sim3Match {
  Eigen::Vector3d point_in_cam1 = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_in_cam2 = Eigen::Vector3d::Zero();
  Eigen::Vector2d normalized1 = Eigen::Vector2d::Zero();  // x / z, y / z, undistorted
  Eigen::Vector2d normalized2 = Eigen::Vector2d::Zero();
  double sigma1_px = 1.0, sigma2_px = 1.0;  // standard deviation of each coordinate
};

struct Sim3RansacOptions {
  int min_inliers = 20;      // fewer agree by chance
  int max_iterations = 300;  // samples of three: enough for 30 percent inliers
  // Of the reprojection in each image, in sigmas; wide, for map points have errors of their own.
  double max_squared_error = kChiSquare99With2Dof;

  void Visit(OptionVisitor& visitor);
};

struct Sim3Estimate {
  Sim3d cam1_from_cam2;
  std::vector<std::uint8_t> is_inlier;  // a match: 1 when both images show it where it should be
  int num_inliers = 0;
};

// The similarity between two cameras from matches of their map points: three points give one in
// closed form (AlignPositions; Horn 1987), which counts by reprojecting each camera's points into
// the other's image; samples better than all before are refined by all matches that nearly agree.
// kFixed: scale 1, where both maps have the same (stereo, or a wheel's). Deterministic for a seed.
// Nothing when too few matches agree. Focal lengths turn sigmas into normalised units.
std::optional<Sim3Estimate> EstimateSim3(std::span<const Sim3Match> matches,
                                         double focal_length1_px, double focal_length2_px,
                                         ScaleFit scale_fit, const Sim3RansacOptions& options,
                                         std::uint64_t seed);

}  // namespace lift_slam
