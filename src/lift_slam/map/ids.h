#pragma once

#include "lift_slam/util/strong_id.h"

namespace lift_slam {

// Keyframes and map points count from 0 within their map.
using KeyFrameId = StrongId<struct KeyFrameTag>;
using MapPointId = StrongId<struct MapPointTag>;

}  // namespace lift_slam
