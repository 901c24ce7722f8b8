#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// A match between two images in normalised coordinates (x / z, y / z), with the standard
// deviation of each coordinate in the same units.
struct NormalizedMatch {
  Eigen::Vector2d in_image1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d in_image2 = Eigen::Vector2d::Zero();
  double sigma = 1.0;
};

// All real essential matrices (Frobenius norm 1) through five matches, at most ten.
// Stewenius, Engels, Nister, "Recent developments on direct relative orientation", 2006: the ten
// cubic constraints on E = x X + y Y + z Z + W are reduced and solved by an action matrix.
std::vector<Eigen::Matrix3d> SolveFivePoint(const std::array<const NormalizedMatch*, 5>& matches);

// The four poses cam2_from_cam1 (translation norm 1) that an essential matrix stands for:
// two rotations, each with both signs of the translation.
std::array<Rigid3d, 4> DecomposeEssential(const Eigen::Matrix3d& essential);

// Minimises the robust sum of squared Sampson errors, in sigmas, over rotation and direction of
// translation (5 degrees of freedom, Levenberg-Marquardt). Truncated loss: errors above
// sqrt(max_squared_error) have no pull. Returns the refined pose with translation norm 1.
Rigid3d RefineRelativePose(std::span<const NormalizedMatch> matches, const Rigid3d& cam2_from_cam1,
                           double max_squared_error, int max_iterations);

}  // namespace lift_slam
