#pragma once

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam {

// The layers of LIFT (paper sec. 3, and the tables of docs/paper_map.md) with zero parameters; the
// kernels of topology T are Gaussian.
nn::Network LiftDetectorLayers();
nn::Network LiftOrientationLayers();
nn::Network LiftDescriptorLayers(LiftTopology topology);

inline constexpr int kLiftPatchSize = 64;        // rows and columns of a patch
inline constexpr int kLiftDescriptorSize = 128;  // values of a descriptor
inline constexpr int kLiftDetectorBorder = 12;   // pixels on each side without a score

}  // namespace lift_slam
