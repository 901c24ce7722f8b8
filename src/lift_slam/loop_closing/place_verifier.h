#pragma once

#include <cstdint>

#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/loop_closing/place_index.h"
#include "lift_slam/loop_closing/place_match.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// A keyframe in its map, with the map's words.
struct PlaceView {
  const Map& map;
  const PlaceIndex& places;
  KeyFrameId keyframe;
};

// Whether two keyframes show the same place by geometry (ORB-SLAM sec. VII-B): map points matched
// by descriptors give a similarity, which is refined while more matches are found by its guidance;
// then the place's points must be seen by the query and by keyframes around it. The maps may be
// two or the same one; nothing is changed. Deterministic for a seed.
PlaceMatch VerifyPlace(const PlaceView& query, const PlaceView& candidate,
                       const PlaceVerificationOptions& options, std::uint64_t seed);

// The keyframe and its best covisible ones, at most `max_neighbors` of them.
std::vector<KeyFrameId> WithNeighbors(const Map& map, KeyFrameId keyframe, int min_shared_points,
                                      int max_neighbors);

}  // namespace lift_slam
