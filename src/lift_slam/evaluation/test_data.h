#pragma once

// Paths and poses shared by the tests of this folder.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "lift_slam/geometry/trajectory.h"
#include "lift_slam/util/random.h"

namespace lift_slam::test {

// A path below the recorded data, or nothing when it is not there.
inline std::optional<std::filesystem::path> FindData(const std::string& relative) {
  std::filesystem::path root;
  if (const char* data = std::getenv("LIFT_SLAM_DATA")) {
    root = data;
  } else if (const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR")) {
    root = std::filesystem::path(source) / ".." / "shared" / "data";
  } else {
    return std::nullopt;
  }
  if (!std::filesystem::exists(root / relative)) return std::nullopt;
  return root / relative;
}

inline Eigen::Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

inline Eigen::Quaterniond RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized();
}

// Frames 0, 1, ... at 10 Hz on a random smooth walk of about a metre a frame.
inline Trajectory RandomWalk(int size, std::uint64_t seed) {
  Random random(seed);
  Trajectory trajectory;
  Rigid3d world_from_cam(RandomRotation(random), RandomVector(random));
  for (int i = 0; i < size; ++i) {
    trajectory.push_back({.frame_index = i,
                          .timestamp_ns = i * std::int64_t{100'000'000},
                          .world_from_cam = world_from_cam});
    const Eigen::Vector3d turn = 0.05 * RandomVector(random);
    const Rigid3d step(Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())),
                       Eigen::Vector3d(0.1 * random.Normal(), 0.1 * random.Normal(), 1.0));
    world_from_cam = world_from_cam * step;
  }
  return trajectory;
}

// Frames 0, 1, ... at 10 Hz, `step_m` apart along z, turning by `yaw_rad` a frame without leaving
// the line.
inline Trajectory StraightLine(int size, double step_m, double yaw_rad = 0.0) {
  Trajectory trajectory;
  for (int i = 0; i < size; ++i) {
    const Eigen::AngleAxisd yaw(yaw_rad * i, Eigen::Vector3d::UnitY());
    trajectory.push_back({.frame_index = i,
                          .timestamp_ns = i * std::int64_t{100'000'000},
                          .world_from_cam = Rigid3d(Eigen::Quaterniond(yaw),
                                                    Eigen::Vector3d(0.0, 0.0, step_m * i))});
  }
  return trajectory;
}

}  // namespace lift_slam::test
