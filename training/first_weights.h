#pragma once

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam::training {

// Where training begins: instead of noise, filters that do roughly what the network is to learn, so
// that thousands of steps are saved. Numbers in the networks' input, (grey - 128) / 128.

// The detector scores blobs of the size that keypoints have in its patches: the absolute Laplacian
// of a Gaussian, less the difference of the two curvatures (so that edges score low), less 1. The
// second half of its hinges begins as little noise.
void BeginWithBlobs(LiftWeights& weights);

// The orientation network points along the mean gradient: eight directional derivatives that pass
// through the pooling, weighted by a Gaussian about the patch's centre. All else begins as little
// noise. CheckError without an orientation network.
void BeginWithGradients(LiftWeights& weights);

}  // namespace lift_slam::training
