#pragma once

#include <filesystem>

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam {

// The weights that are used when none are named: the file that the environment variable
// LIFT_SLAM_WEIGHTS names, or else the one that ships, weights/lift-default.safetensors (see
// ShippedFile).
std::filesystem::path DefaultLiftWeights();

// Of a file, or the default ones when `file` is empty. Throws InputError as ReadLiftWeights, and
// says how to name a file when the default one is missing.
LiftWeights ReadLiftWeightsOrDefault(const std::filesystem::path& file);

}  // namespace lift_slam
