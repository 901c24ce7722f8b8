#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Writes each pose of a run the moment it is known (TUM format, map units), so that a killed
// process leaves the trajectory so far.
class OnlineTrajectoryWriter {
 public:
  // Empties the file. Throws InputError when it cannot be created.
  explicit OnlineTrajectoryWriter(const std::filesystem::path& path);

  // Appends the pose and hands it to the operating system; frames without pose are left out.
  // Throws InputError when the disk is full.
  void Append(const TrajectoryPose& pose);

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
  bool has_header_ = false;
};

}  // namespace lift_slam
