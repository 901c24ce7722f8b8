#pragma once

#include <string>
#include <vector>

#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/geometry/trajectory_io.h"

namespace lift_slam {

// What the user said about the two files of `lift_slam evaluate`.
struct EvaluationFiles {
  std::string reference, estimate;  // paths
  std::string reference_format = "auto", format = "auto";
  std::string times;        // path of a file with the stamp of each frame; empty: none
  std::string sensor_yaml;  // path of EuRoC's cam0/sensor.yaml; empty: none
};

inline constexpr const char* kTrajectoryFormatNames[] = {"auto", "tum", "kitti", "euroc"};

// The two trajectories, ready for Evaluate.
struct EvaluationInput {
  Trajectory estimate, reference;
  TrajectoryFormat estimate_format = TrajectoryFormat::kTum;
  TrajectoryFormat reference_format = TrajectoryFormat::kTum;
  std::vector<std::string> warnings;
};

// Reads both files, gives KITTI poses their times, moves a reference of the body to the camera
// unless options.gt_frame is kBody, and sets options.estimate_lists_every_frame when the times of
// all frames are known. Throws InputError.
EvaluationInput LoadEvaluationInput(const EvaluationFiles& files, EvaluationOptions& options);

}  // namespace lift_slam
