#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lift_slam::nn {

// Arithmetic of convolutions and fully connected layers; all else is float32.
enum class Precision {
  kFloat32,
  kBfloat16,  // weights and activations rounded to bfloat16, sums in float32
  kInt8,      // 8-bit weights (a scale per output channel) and activations, sums in int32
  // A wish only: bfloat16, or where the CPU lacks it int8, or where that cannot be had float32.
  kAuto,
};
inline constexpr std::string_view kPrecisionNames[] = {"float32", "bfloat16", "int8", "auto"};
std::string_view Name(Precision precision);
// Of a name of the list; CheckError for any other.
Precision ParsePrecision(std::string_view name);

struct PrecisionChoice {
  Precision used = Precision::kFloat32;
  std::string reason;  // why it is not what was wanted; empty when it is, and for kAuto
};

// Never kAuto: the wanted precision, or the next higher one that runs fast on a CPU with these
// features (names of CpuFeatures() in util/system_info.h). int8 also needs the ranges of the
// activations.
PrecisionChoice ChoosePrecision(Precision wanted, std::span<const std::string> cpu_features,
                                bool has_activation_ranges);

}  // namespace lift_slam::nn
