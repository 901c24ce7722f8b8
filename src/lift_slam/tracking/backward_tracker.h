#pragma once

#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/tracking/tracker_options.h"

namespace lift_slam {

// A frame that got its pose after the map was begun.
struct BackfilledFrame {
  std::int64_t frame_index = -1;
  KeyFrameId reference;
  Rigid3d cam_from_reference;
  int num_inliers = 0;
};

// Gives poses to the frames that waited for the first map: from the newest to the oldest, by
// constant velocity backwards, within the map as it is. Stops at the first frame that cannot be
// tracked. The final trajectory then has no gap at its beginning; the online one keeps it.
std::vector<BackfilledFrame> TrackBackwards(const Map& map, const Frame& current,
                                            std::vector<Frame> waiting,
                                            const TrackerOptions& options);

}  // namespace lift_slam
