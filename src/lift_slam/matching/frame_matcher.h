#pragma once

#include <span>
#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// Guided matching of map points into a frame: each function fills frame.map_points where it finds
// a feature and returns the number of matches added. The frame's cam_from_world must hold the
// predicted pose. `max_distance` is of descriptors.

// Points matched in the previous frame, looked for around their projection. Features of about the
// same level; the window's half side is radius_px on level 0 and grows with the level.
int MatchFromLastFrame(const Map& map, const Frame& last, float radius_px, float max_distance,
                       Frame& frame);

struct LocalMatchResult {
  int num_matches = 0;
  std::vector<MapPointId> visible;  // points that should be seen, matched already or not
};
// Points of the local map not matched yet. `radius_factor` widens the windows (1: normal).
LocalMatchResult MatchLocalPoints(const Map& map, std::span<const MapPointId> points,
                                  float radius_factor, float max_distance, Frame& frame);

// All features of the frame against those of a keyframe that have map points, without any
// prediction: nearest neighbour with ratio and rotation checks.
int MatchFromKeyFrame(const Map& map, const KeyFrame& keyframe, float max_distance, Frame& frame);

}  // namespace lift_slam
