#pragma once

#include <string_view>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// Smooth camera motions through the textured worlds of textured_world.h. World frame: x right,
// y DOWN, z forward, metres.
enum class SyntheticPath {
  kStreetDrive,   // forward at 8 m/s along a street with curves, slight pitch and roll; 400 m long
  kRoomSway,      // hand-held: sways and turns before furniture, 2 to 5 m away
  kRoomRotation,  // turns on the spot, no translation
  kRoomStill,     // does not move at all
  kRoomLoop,      // once around the room in 20 s, looking ahead; then again
};
std::string_view Name(SyntheticPath path);

// Pose at a time (seconds from 0 on).
Rigid3d WorldFromCamOnPath(SyntheticPath path, double time_s);

// How long a path goes on; infinite for those that repeat.
double PathDurationS(SyntheticPath path);

// The middle of the street after `distance` metres: world_from_street, whose z runs along it.
Rigid3d WorldFromStreet(double distance);
inline constexpr double kStreetLength = 400.0;

}  // namespace lift_slam
