#pragma once

namespace lift_slam {

// Upper limit of a squared, variance-weighted reprojection error: chi-square with 2 degrees of
// freedom (one pixel, x and y) at 95 %, that is -2 ln 0.05. A right observation exceeds it in 1 of
// 20 cases.
inline constexpr double kChiSquare2Dof95Percent = 5.991464547107979;

// Points nearer to the image plane than this, or behind it, are not seen (map units along z). Far
// below any depth of a map, whose scale is set near 1 at its start; keeps 1 / z^2 finite.
inline constexpr double kMinDepth = 1e-6;

}  // namespace lift_slam
