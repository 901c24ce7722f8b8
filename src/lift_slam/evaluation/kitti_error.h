#pragma once

#include <span>
#include <vector>

#include "lift_slam/evaluation/association.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Mean relative error over segments. Without segments the values mean nothing (print "n/a").
struct SegmentErrors {
  int num_segments = 0;
  double translation_pct = 0.0;     // t_rel: percent of the segment's nominal length
  double rotation_deg_per_m = 0.0;  // r_rel: degrees per metre of nominal length
};

struct KittiError {
  SegmentErrors all;  // plain mean over all segments of all lengths
  struct Length {
    double length_m = 0.0;
    SegmentErrors errors;
  };
  std::vector<Length> by_length;  // 100, 200, ..., 800 m
};

// The relative error of the KITTI odometry benchmark (Geiger, Lenz, Urtasun, CVPR 2012, and its
// development kit). Segments begin at every tenth reference frame and end at the first frame whose
// path from there is strictly longer than the length; a segment whose ends have no estimate is
// left out. `reference` holds every frame; `aligned` pairs are aligned to it, paired by index.
KittiError ComputeKittiError(const Trajectory& reference, std::span<const PosePair> aligned);

// Path length from the first pose to each pose, in metres.
std::vector<double> CumulativePathLength(const Trajectory& trajectory);

}  // namespace lift_slam
