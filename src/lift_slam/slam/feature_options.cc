#include "lift_slam/slam/feature_options.h"

#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

std::unique_ptr<FeatureExtractor> CreateFeatureExtractor(const FeatureOptions& options) {
  if (options.type == FeatureType::kOrb) return CreateOrbExtractor(options.orb);
  if (options.lift_weights.empty()) {
    throw InputError("LIFT features need their weights: --weights FILE (.safetensors)");
  }
  return CreateLiftExtractor(ReadLiftWeights(options.lift_weights), options.lift);
}

}  // namespace lift_slam
