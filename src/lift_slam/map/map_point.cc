#include "lift_slam/map/map_point.h"

namespace lift_slam {

int MapPoint::FeatureIn(KeyFrameId keyframe) const {
  for (const Observation& observation : observations) {
    if (observation.keyframe == keyframe) return observation.feature;
  }
  return -1;
}

}  // namespace lift_slam
