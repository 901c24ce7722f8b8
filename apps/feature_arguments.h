#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "lift_slam/features/feature_extractor.h"

namespace CLI {
class App;
}

namespace lift_slam {

// The arguments that choose an extractor of features.
struct FeatureArguments {
  std::string features;           // "orb" or "lift"; empty: lift when weights are given, else orb
  std::filesystem::path weights;  // of LIFT; empty: those that ship
  int max_features = 0;           // an image; 0: the extractor's default
  bool upright = true;            // LIFT's patches are not turned
  std::filesystem::path feature_cache;  // folder that keeps features; empty: none
  int num_threads = 2;

  // Adds them to a command; *this must outlive it.
  void AddTo(CLI::App& command);
  // Throws InputError for weights that are missing, superfluous or unfit.
  std::unique_ptr<FeatureExtractor> MakeExtractor() const;
  // What determines the features, as text.
  std::string Key(const DescriptorKind& kind) const;
};

}  // namespace lift_slam
