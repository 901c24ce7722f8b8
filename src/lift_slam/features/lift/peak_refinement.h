#pragma once

#include <optional>
#include <span>

#include "lift_slam/features/lift/scale_space_maxima.h"

namespace lift_slam {

// A keypoint in the full-size image, pixel (0, 0) the centre of the top-left pixel.
struct LiftKeypoint {
  double x = 0.0, y = 0.0;
  double sigma = 1.0;  // scale in pixels: the descriptor looks at 6 sigma to each side
  float score = 0.0F;
};

// The largest value of the quadratic function that fits the scores around the peak, in x, y and
// level (central differences). Nothing where a score around it is missing, where the peak is more
// of a ridge (trace^2 / determinant of the Hessian in x and y beyond that of eigenvalues
// max_edge_ratio : 1), or where the largest value is 1.5 pixels or levels away.
std::optional<LiftKeypoint> RefinePeak(std::span<const ScoreLevel> levels, const ScorePeak& peak,
                                       double max_edge_ratio, LevelCoordinates how);

}  // namespace lift_slam
