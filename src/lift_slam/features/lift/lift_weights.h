#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/nn/layers.h"

namespace lift_slam {

// The two descriptors that go by the name of LIFT.
enum class LiftTopology {
  kF,  // ReLU, average pooling (the authors' second code; what LIFT-SLAM used; ours)
  kT,  // tanh, L2 pooling, subtractive normalisation (the paper of 2016)
};
inline constexpr std::string_view kLiftTopologyNames[] = {"F", "T"};
std::string_view Name(LiftTopology topology);

// Grey value v (0 to 255) enters a network as (v - mean) / scale.
struct InputNormalization {
  float mean = 128.0F;
  float scale = 128.0F;
  bool operator==(const InputNormalization&) const = default;
};

// Euclidean distances of descriptors as measured with these weights: the 5, 25, 50, 75 and 95 %
// quantiles over pairs that match, and over each patch and the nearest that does not match.
struct DistanceQuantiles {
  std::array<float, 5> matching{};
  std::array<float, 5> nearest_wrong{};
  bool operator==(const DistanceQuantiles&) const = default;
};

// Everything that training gives, one file. Patches are 64 x 64 grey values.
struct LiftWeights {
  std::string name;
  LiftTopology topology = LiftTopology::kF;
  InputNormalization detector_input, orientation_input, descriptor_input;
  nn::Network detector;                    // image -> score map, 24 rows and columns smaller
  std::optional<nn::Network> orientation;  // patch -> 2 values along (cos, sin); none: upright
  nn::Network descriptor;                  // patch -> 128 values, not normalised
  std::string provenance;                  // data, program and options of the training
  std::optional<DistanceQuantiles> distances;
  // For int8: largest absolute input of each of the descriptor's convolutions; empty: not measured.
  std::vector<float> descriptor_ranges;
  std::string sha256;  // of the file (nn/weight_file.h); empty when never saved
};

// The file's names of one parameter and where it belongs. Shapes:
//   detector.conv1.weight [16, 1, 25, 25], .bias [16]
//   orientation.conv1.weight [10, 1, 5, 5], conv2 [20, 10, 5, 5], conv3 [50, 20, 3, 3] with .bias
//   orientation.fc1.weight [1600, 1250] (inputs in the order channel, row, column), fc2 [32, 100]
//   descriptor.conv1.weight [32, 1, 7, 7], conv2 [64, 32, 6, 6], conv3 [128, 64, 5, 5] with .bias
//   descriptor.norm1.kernel [5, 5], norm2.kernel (topology T only; each sums to 1)
// A file without any "orientation." tensor has no orientation network.
struct LiftParameter {
  std::string name;
  std::vector<std::int64_t> shape;
  std::span<float> values;
};
std::vector<LiftParameter> Parameters(LiftWeights& weights);

// All networks with every parameter zero: what a reader fills in.
LiftWeights ZeroLiftWeights(LiftTopology topology, bool with_orientation);
// He initialisation: normal with deviation sqrt(2 / inputs), biases zero. For tests and training.
LiftWeights RandomLiftWeights(LiftTopology topology, std::uint64_t seed,
                              bool with_orientation = true);

// Throws InputError, naming the file and what was expected, when it is no safetensors file of LIFT
// weights with exactly these tensors and sensible metadata.
LiftWeights ReadLiftWeights(const std::filesystem::path& path);
// Atomically; sets weights.sha256.
void WriteLiftWeights(LiftWeights& weights, const std::filesystem::path& path);

}  // namespace lift_slam
