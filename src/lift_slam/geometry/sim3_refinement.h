#pragma once

#include <span>

#include "lift_slam/geometry/alignment.h"
#include "lift_slam/geometry/sim3_ransac.h"

namespace lift_slam {

// Minimises the squared reprojection errors of both cameras' points, in sigmas (7 degrees of
// freedom, 6 with kFixed; Levenberg-Marquardt); errors above max_squared_error have no pull.
Sim3d RefineSim3(std::span<const Sim3Match> matches, double focal_length1_px,
                 double focal_length2_px, const Sim3d& cam1_from_cam2, ScaleFit scale_fit,
                 double max_squared_error, int max_iterations);

}  // namespace lift_slam
