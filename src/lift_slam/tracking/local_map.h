#pragma once

#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// The part of the map around a frame (ORB-SLAM sec. V-D; paper sec. 3.2 "Tracking").
struct LocalMap {
  std::vector<KeyFrameId> keyframes;  // most shared points first, then their neighbours
  std::vector<MapPointId> points;     // seen by them, ascending by id
  KeyFrameId reference;               // shares most points with the frame; invalid: none
};

// Keyframes that see the frame's matched points (K1) and the best covisible ones of those (K2), at
// most `max_keyframes`.
LocalMap CollectLocalMap(const Map& map, const Frame& frame, int max_keyframes);

}  // namespace lift_slam
