#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lift_slam/geometry/essential_matrix.h"
#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// The homography x2 ~ H x1 (Frobenius norm 1, positive on the matches' side) that fits four or
// more matches best in the algebraic sense, weighted by 1 / sigma. Nothing when the matches are
// degenerate (four with three on a line, fewer than four) or H is singular.
std::optional<Eigen::Matrix3d> FitHomography(std::span<const NormalizedMatch> matches);

// Squared error of a match in sigmas: a quarter of the symmetric squared transfer error, which for
// homographies near an isometry approximates the distance to the nearest fulfilling pair
// (chi-square, 2 degrees of freedom). Infinite where the homography maps to infinity or behind.
double SquaredHomographyError(const Eigen::Matrix3d& homography,
                              const Eigen::Matrix3d& inverse_homography,
                              const NormalizedMatch& match);

// The poses cam2_from_cam1 (translation norm 1) that a plane's homography (positive as from
// FitHomography) stands for: four, or none when it is a pure rotation.
// Ma, Soatto, Kosecka, Sastry, An Invitation to 3-D Vision, sec. 5.3.3.
std::vector<Rigid3d> DecomposeHomography(const Eigen::Matrix3d& homography);

// The rotation cam2_from_cam1 that aligns the viewing rays best (Kabsch, weighted by 1 / sigma^2).
Eigen::Matrix3d FitRotation(std::span<const NormalizedMatch> matches);

// Half the squared transfer error of a pure rotation, in sigmas (chi-square, 2 degrees of
// freedom); infinite when the rotated point is not in front.
double SquaredRotationError(const Eigen::Matrix3d& rotation, const NormalizedMatch& match);

}  // namespace lift_slam
