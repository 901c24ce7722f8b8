#pragma once

namespace lift_slam {

// Limits below which a chi-square distributed squared error (in sigmas) falls with probability
// 0.95, by degrees of freedom: a right observation exceeds them in 1 of 20 cases. With 2 (the x and
// y of one pixel) the limit is -2 ln 0.05.
inline constexpr double kChiSquare95With1Dof = 3.841458820694124;
inline constexpr double kChiSquare95With2Dof = 5.991464547107979;

// The same with probability 0.99, -2 ln 0.01: where the model is still rough.
inline constexpr double kChiSquare99With2Dof = 9.210340371976182;

}  // namespace lift_slam
