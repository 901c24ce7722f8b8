#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Reference poses of a sequence, sorted by time.
struct GroundTruth {
  Trajectory poses;  // world_from_cam of the camera that runs
  // The file's own poses (world_from_body) where they are of another frame than the camera.
  std::optional<Trajectory> body_poses;
  std::string source;     // file
  bool by_index = false;  // KITTI: paired by frame index; the poses have no times of their own
};

// One sentence when the two time ranges have no overlap, with both ranges and, where they differ
// as seconds and nanoseconds do, that suspicion. Nothing when they overlap.
std::optional<std::string> DescribeMissingOverlap(const Trajectory& truth,
                                                  std::int64_t first_frame_ns,
                                                  std::int64_t last_frame_ns);

}  // namespace lift_slam
