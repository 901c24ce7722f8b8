#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// All poses cam_from_world (at most four) that see three world points along three unit rays of the
// camera. Grunert's solution as given by Haralick et al., "Review and analysis of solutions of the
// three point perspective pose estimation problem", 1994, with the distances polished by Newton's
// method. Empty for degenerate triples (points on a line or coinciding).
std::vector<Rigid3d> SolveP3p(const std::array<Eigen::Vector3d, 3>& points_in_world,
                              const std::array<Eigen::Vector3d, 3>& rays_in_cam);

}  // namespace lift_slam
