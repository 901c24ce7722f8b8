#pragma once

#include <vector>

#include "lift_slam/features/lift/lift_weights.h"
#include "training/patch_sampler.h"

namespace lift_slam::training {

struct CalibrationSize {
  int batches = 64;         // of 128 points, for the distances
  int range_patches = 256;  // for the ranges of activations
};

// Measures on points of the sets, without changes of light, and stores in the weights: quantiles of
// the descriptor's distances, and the ranges of its activations, for int8. With `nearest_wrong` > 0
// the descriptor is scaled first, so that this is the median distance of the nearest wrong point.
// Topology F only.
void CalibrateDescriptor(const std::vector<WeightedSet>& sets, const CalibrationSize& size,
                         double nearest_wrong, LiftWeights& weights);

// After more training of `from`, whose descriptor it may have changed: scales the descriptor, so
// that the nearest wrong point of the sets is as far as with `from` (median), and measures anew.
// The quantiles that `from` came with (of whole images) are kept, each changed by the factor by
// which it has changed on these sets.
void CarryOverCalibration(const LiftWeights& from, const std::vector<WeightedSet>& sets,
                          const CalibrationSize& size, LiftWeights& weights);

}  // namespace lift_slam::training
