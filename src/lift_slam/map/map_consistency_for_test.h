#pragma once

#include <gtest/gtest.h>

#include <map>

#include "lift_slam/map/map.h"

namespace lift_slam {

// Points and keyframes must name each other, edges must count shared points, and observations be in
// order of keyframe.
inline void ExpectConsistent(const Map& map) {
  std::map<std::pair<KeyFrameId, KeyFrameId>, int> shared;
  for (const MapPointId id : map.PointIds()) {
    const MapPoint& point = map.point(id);
    EXPECT_EQ(point.id, id);
    KeyFrameId previous;
    for (const auto& observation : point.observations) {
      EXPECT_LT(previous, observation.keyframe);
      previous = observation.keyframe;
      const KeyFrame& keyframe = map.keyframe(observation.keyframe);
      EXPECT_EQ(keyframe.map_points[static_cast<std::size_t>(observation.feature)], id);
      for (const auto& other : point.observations) {
        if (other.keyframe != keyframe.id) ++shared[{keyframe.id, other.keyframe}];
      }
    }
  }
  EXPECT_EQ(static_cast<int>(map.KeyFrameIds().size()), map.num_keyframes());
  EXPECT_EQ(static_cast<int>(map.PointIds().size()), map.num_points());
  for (const KeyFrameId a : map.KeyFrameIds()) {
    EXPECT_EQ(map.keyframe(a).id, a);
    for (const MapPointId id : map.keyframe(a).map_points) {
      if (!id.valid()) continue;
      ASSERT_NE(map.FindPoint(id), nullptr);
      EXPECT_GE(map.point(id).FeatureIn(a), 0);
    }
    for (const KeyFrameId b : map.KeyFrameIds()) {
      if (a == b) continue;
      const auto found = shared.find({a, b});
      EXPECT_EQ(map.covisibility().SharedPoints(a, b), found == shared.end() ? 0 : found->second);
    }
  }
}

}  // namespace lift_slam
