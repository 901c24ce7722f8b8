#pragma once

#include <string>

#include "lift_slam/features/lift/keypoint_detection.h"
#include "lift_slam/nn/precision.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct LiftExtractorOptions {
  // Features per image; 0: all that are found.
  int max_features = 1000;
  // They are chosen from this many times as many, the strongest. 1: the strongest, wherever they
  // are; large: spread evenly, but half of them do not repeat in the next frame (KITTI 06).
  double candidate_ratio = 1.3;
  LiftDetectorOptions detector = {};
  // Of the descriptor and the orientation, where the CPU has it (else the next higher one). By
  // docs/lift.md bfloat16 and int8 tell descriptors apart as well as float32, in half the time.
  nn::Precision precision = nn::Precision::kAuto;
  // Patches are not turned. Unlike the authors of LIFT: frames of one camera seldom differ by much
  // roll, and the orientation's errors cost a tenth to half of the inliers (docs/training.md). To
  // be set to false for a camera that rolls; the weights must have an orientation network then.
  bool upright = true;
  // Standard deviation of the position of a keypoint of sigma 1, pixels; grows with sigma. The
  // scores have about one pixel for a sigma of 2.
  double sigma_px = 0.65;
  // Distances of descriptors below which two are taken for the same point, strictly and loosely,
  // where nothing adapts them; 0: from what was measured with the weights, or the paper's of KITTI,
  // 2 and 3.
  double low_threshold = 0.0;
  double high_threshold = 0.0;
  // Threads, the caller included; 0: all that the machine has. The result does not depend on it.
  int num_threads = 0;

  void Visit(OptionVisitor& visitor);
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

}  // namespace lift_slam
