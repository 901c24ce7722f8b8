#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam {

// The authors released two detectors of topology F: trained with random rotations, and without.
enum class ReleasedDetector { kAugmented, kNotAugmented };
inline constexpr std::string_view kReleasedDetectorNames[] = {"aug", "noaug"};

struct LiftImport {
  ReleasedDetector detector = ReleasedDetector::kAugmented;
  LiftTopology topology = LiftTopology::kF;  // of the descriptor
};

// Weights that the authors of LIFT released, from HDF5 files (academic use only; LIFT is patented):
// "new-CNN3-picc-iter-56k.h5" (descriptor T; groups "l-1-weights"...) and "tf-lift-release.h5"
// (descriptor F and both detectors; groups "desc/conv1/weight"...). The files are told apart by
// their contents; together they must hold a detector and the descriptor wanted. No orientation.
// Throws InputError, naming the file, when one is missing, is not HDF5 or has other shapes.
LiftWeights ImportLiftWeights(std::span<const std::filesystem::path> files,
                              const LiftImport& wanted);

}  // namespace lift_slam
