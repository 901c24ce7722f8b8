#include "lift_slam/simulation/scene/road.h"

namespace lift_slam {

double RoadLength(const Road& road) {
  double length = 0.0;
  for (std::size_t i = 0; i < road.sections.size(); ++i) {
    const RoadSection& next = road.sections[(i + 1) % road.sections.size()];
    length += (next.Center() - road.sections[i].Center()).norm();
  }
  return length;
}

}  // namespace lift_slam
