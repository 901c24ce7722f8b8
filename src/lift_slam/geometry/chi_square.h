#pragma once

namespace lift_slam {

// Limits below which a chi-square distributed squared error (in sigmas) falls with probability
// 0.95, by degrees of freedom.
inline constexpr double kChiSquare95With1Dof = 3.841;
inline constexpr double kChiSquare95With2Dof = 5.991;
inline constexpr double kChiSquare95With3Dof = 7.815;

}  // namespace lift_slam
