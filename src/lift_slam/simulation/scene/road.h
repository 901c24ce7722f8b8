#pragma once

#include <Eigen/Core>
#include <vector>

namespace lift_slam {

// One cross-section of a road, scene frame, metres; left and right as seen in driving direction.
struct RoadSection {
  Eigen::Vector3d left;
  Eigen::Vector3d right;

  Eigen::Vector3d Center() const { return 0.5 * (left + right); }
};

// A road as a closed loop of cross-sections in driving order; the first follows the last.
struct Road {
  std::vector<RoadSection> sections;
};

// Length of the closed centre line, metres.
double RoadLength(const Road& road);

}  // namespace lift_slam
