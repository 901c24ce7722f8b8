#include "lift_slam/features/lift/default_weights.h"

#include <fmt/format.h>

#include "lift_slam/util/environment.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/shipped_file.h"

namespace lift_slam {

std::filesystem::path DefaultLiftWeights() {
  if (const auto chosen = EnvironmentPath("LIFT_SLAM_WEIGHTS")) return *chosen;
  return ShippedFile("weights/lift-default.safetensors");
}

LiftWeights ReadLiftWeightsOrDefault(const std::filesystem::path& file) {
  if (!file.empty()) return ReadLiftWeights(file);
  const std::filesystem::path path = DefaultLiftWeights();
  if (!std::filesystem::exists(path)) {
    throw InputError(
        fmt::format("LIFT's default weights '{}' are missing: name others by --weights FILE or by "
                    "the environment variable LIFT_SLAM_WEIGHTS",
                    path.string()));
  }
  return ReadLiftWeights(path);
}

}  // namespace lift_slam
