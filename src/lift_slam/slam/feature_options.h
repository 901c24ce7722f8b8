#pragma once

#include <memory>
#include <string>

#include "lift_slam/features/feature_cache.h"
#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/features/lift/lift_options.h"
#include "lift_slam/features/orb/orb_options.h"

namespace lift_slam {

enum class FeatureType { kOrb, kLift };
inline constexpr std::string_view kFeatureTypeNames[] = {"orb", "lift"};

// Which features, and how they are made.
struct FeatureOptions {
  FeatureType type = FeatureType::kOrb;
  std::string lift_weights;  // file (.safetensors); empty: those that ship
  OrbOptions orb;
  LiftExtractorOptions lift = {};
};

// Throws InputError for options out of range, and for weights that are missing or damaged. With a
// cache, features of images seen before come from there.
std::unique_ptr<FeatureExtractor> CreateFeatureExtractor(
    const FeatureOptions& options, std::shared_ptr<FeatureCache> cache = nullptr);

}  // namespace lift_slam
