#include "lift_slam/nn/precision.h"

#include <algorithm>
#include <iterator>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {

std::string_view Name(Precision precision) {
  return kPrecisionNames[static_cast<std::size_t>(precision)];
}

Precision ParsePrecision(std::string_view name) {
  const auto found = std::ranges::find(kPrecisionNames, name);
  LIFT_SLAM_CHECK(found != std::end(kPrecisionNames), "precision '{}' is unknown", name);
  return static_cast<Precision>(found - std::begin(kPrecisionNames));
}

PrecisionChoice ChoosePrecision(Precision wanted, std::span<const std::string> cpu_features,
                                bool has_activation_ranges) {
  const auto has = [&](std::string_view name) {
    return std::find(cpu_features.begin(), cpu_features.end(), name) != cpu_features.end();
  };
  if (wanted == Precision::kFloat32) return {};
  const bool can_use_int8 = has("avx512_vnni") && has_activation_ranges;
  if (wanted == Precision::kAuto) {
    return {has("avx512_bf16") ? Precision::kBfloat16
            : can_use_int8     ? Precision::kInt8
                               : Precision::kFloat32,
            ""};
  }
  std::string reason;
  if (wanted == Precision::kInt8) {
    if (can_use_int8) return {Precision::kInt8, ""};
    reason = has_activation_ranges ? "int8 needs a CPU with AVX-512 VNNI"
                                   : "int8 needs the ranges of the activations, which these "
                                     "weights lack";
  }
  if (has("avx512_bf16")) return {Precision::kBfloat16, reason};
  if (!reason.empty()) reason += "; ";
  return {Precision::kFloat32, reason + "bfloat16 needs a CPU with AVX-512 BF16"};
}

}  // namespace lift_slam::nn
