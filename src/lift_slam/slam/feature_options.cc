#include "lift_slam/slam/feature_options.h"

#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"

namespace lift_slam {

std::unique_ptr<FeatureExtractor> CreateFeatureExtractor(const FeatureOptions& options) {
  if (options.type == FeatureType::kOrb) return CreateOrbExtractor(options.orb);
  return CreateLiftExtractor(ReadLiftWeightsOrDefault(options.lift_weights), options.lift);
}

}  // namespace lift_slam
