#pragma once

#include <filesystem>

#include "apps/finished_run.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Files that not every user needs.
struct RunOutputOptions {
  bool kitti = false;   // trajectories also in KITTI's form (13 columns where frames are missing)
  bool euroc = false;   // trajectories also with stamps in nanoseconds
  bool colmap = false;  // a COLMAP text model of each map
  bool report = true;   // report.html

  void Visit(OptionVisitor& visitor);
};

// Writes into an existing folder, each file whole or not at all:
//   trajectory.tum, trajectory_online.tum, keyframes.tum   poses of the run, map units
//   trajectory.kitti, .euroc and so on                     on request
//   trajectory_aligned.tum                                 in the ground truth's frame, metres
//   map.ply, colmap/N/{cameras,images,points3D}.txt        the maps; colmap on request
//   result.json, config.yaml, report.html
// result.json comes last: when it is there, all others are. Throws InputError when the folder is
// not writable or the disk is full.
void WriteRunOutputs(const FinishedRun& finished, const std::filesystem::path& folder,
                     RunOutputOptions options);

}  // namespace lift_slam
