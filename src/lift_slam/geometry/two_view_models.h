#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lift_slam/geometry/essential_matrix.h"
#include "lift_slam/geometry/ransac.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

// A model between two images found by random sampling. The score is MSAC's: the sum over inliers
// of (limit - squared error in sigmas), larger is better; the limit is the 95 percent chi-square
// limit of the model's degrees of freedom.
struct TwoViewModel {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double score = 0.0;
  int inliers = 0;
};

// The best essential matrices (Sampson error, 5-point samples) that differ from one another, best
// first, at most `max_candidates`. Several are kept because with little parallax or a planar scene
// wrong ones score nearly as well.
std::vector<TwoViewModel> FindEssentialMatrices(std::span<const NormalizedMatch> matches,
                                                const RansacLimits& limits, int max_candidates,
                                                Random& random);

// The best homography, polished on its inliers; nothing when no sample gave one.
std::optional<TwoViewModel> FindHomography(std::span<const NormalizedMatch> matches,
                                           const RansacLimits& limits, Random& random);

// The best pure rotation cam2_from_cam1, polished on its inliers.
TwoViewModel FindRotation(std::span<const NormalizedMatch> matches, const RansacLimits& limits,
                          Random& random);

}  // namespace lift_slam
