#pragma once

#include <span>
#include <vector>

#include "lift_slam/evaluation/association.h"

namespace lift_slam {

// Absolute errors of aligned pairs, one each: e_i = ||p'_i - y_i|| in metres, and the angle of
// R_reference^T R'_estimate in degrees.
std::vector<double> PositionErrorsM(std::span<const PosePair> aligned);
std::vector<double> RotationErrorsDeg(std::span<const PosePair> aligned);

}  // namespace lift_slam
