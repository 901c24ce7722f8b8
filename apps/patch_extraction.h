#pragma once

#include <filesystem>
#include <string>

#include "lift_slam/features/lift/lift_options.h"

namespace lift_slam {

// What `lift_slam extract --patches` is asked for.
struct PatchExtraction {
  std::filesystem::path patches;  // uint8, 64 x 64 each, row by row, one after the other
  std::string shape;              // "N,64,64"; empty: as many as the file holds
  std::filesystem::path weights;
  std::filesystem::path output;  // .npy
  bool orientation = false;      // angles too
  nn::Precision precision = nn::Precision::kFloat32;
  int num_threads = 1;
};

// NAME_angles.npy beside NAME.npy.
std::filesystem::path AnglesFile(const std::filesystem::path& output);

// Writes the descriptors of the patches as they are, float32 N x 128, to the output, and with
// `orientation` their angles, float32 N, radians in (-pi, pi], to AnglesFile. For checks of the
// networks alone. Throws InputError when the file does not fit the shape, the shape is not N,64,64,
// or angles are wanted of weights without an orientation network.
void ExtractPatches(const PatchExtraction& wanted);

}  // namespace lift_slam
