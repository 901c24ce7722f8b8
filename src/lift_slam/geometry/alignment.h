#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/geometry/sim3.h"

namespace lift_slam {

// How an estimated trajectory is laid over the reference before errors are measured.
enum class AlignmentMode {
  kNone,       // as it is
  kOrigin,     // rigid; the first poses coincide
  kScale,      // first poses coincide, then the scale sum(x.y) / sum(x.x) of the rest
  kScaleSim3,  // only the scale of the Sim(3) fit
  kSe3,        // least squares, 6 degrees of freedom
  kSim3,       // least squares with scale, 7 degrees of freedom; for monocular
};

inline constexpr std::string_view kAlignmentModeNames[] = {"none",       "origin", "scale",
                                                           "scale_sim3", "se3",    "sim3"};

std::string_view Name(AlignmentMode mode);

// Why no alignment exists.
enum class AlignmentFailure {
  kNone,
  kTooFewPoses,       // fewer than the mode needs (3 for least squares, else 1)
  kNoExtent,          // all positions are equal
  kCollinear,         // the positions lie on one line: the roll about it is free
  kScaleNotPositive,  // the motions oppose each other
};

// One sentence for people.
std::string_view Explain(AlignmentFailure failure);

struct Alignment {
  // Maps the estimate's world to the reference's; nothing when degenerate. A pose goes through
  // TransformWorld (sim3.h): the scale never touches its rotation.
  std::optional<Sim3d> reference_from_estimate;
  AlignmentFailure failure = AlignmentFailure::kNone;
};

enum class ScaleFit { kFixed, kFree };

// Least-squares similarity of paired positions (Umeyama 1991, eq. 39-42): minimises
// sum ||y_i - (s R x_i + t)||^2 with x = estimate, y = reference; kFixed keeps s = 1.
// Degenerate when fewer than two singular values of the covariance exceed 1e-12 of the largest.
// Sizes must be equal.
Alignment AlignPositions(std::span<const Eigen::Vector3d> estimate,
                         std::span<const Eigen::Vector3d> reference, ScaleFit scale_fit);

// Alignment of paired poses world_from_cam by any mode. Sizes must be equal. For kScale, where the
// definition moves both trajectories to their first pose, the result is the same relation seen
// from the unmoved reference: all errors are equal.
Alignment AlignPoses(std::span<const Rigid3d> estimate, std::span<const Rigid3d> reference,
                     AlignmentMode mode);

}  // namespace lift_slam
