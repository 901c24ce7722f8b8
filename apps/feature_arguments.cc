#include "apps/feature_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "lift_slam/slam/feature_options.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

void FeatureArguments::AddTo(CLI::App& command) {
  command.add_option("--features", features, "Kind of features (default: lift with --weights)")
      ->check(CLI::IsMember({"orb", "lift"}));
  command.add_option("--weights", weights, "LIFT weights (.safetensors; default: those that ship)");
  command.add_option("--max-features", max_features, "Features an image; 0: the extractor's own")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command.add_flag("--upright,!--turned", upright,
                   "LIFT's patches are not turned (default), or turned by the orientation network");
  command.add_option("--feature-cache", feature_cache,
                     "Folder that keeps features: further commands and runs find them there");
  command.add_option("--threads", num_threads, "Threads")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
}

std::unique_ptr<FeatureExtractor> FeatureArguments::MakeExtractor() const {
  const bool is_lift = features == "lift" || (features.empty() && !weights.empty());
  if (!is_lift && !weights.empty())
    throw InputError("ORB features have no weights: leave --weights out");
  FeatureOptions options;
  options.type = is_lift ? FeatureType::kLift : FeatureType::kOrb;
  options.lift_weights = weights.string();
  if (max_features > 0) options.lift.max_features = options.orb.max_features = max_features;
  options.lift.upright = upright;
  options.lift.num_threads = options.orb.num_threads = num_threads;
  return CreateFeatureExtractor(
      options, feature_cache.empty() ? nullptr : std::make_shared<FeatureCache>(feature_cache));
}

std::string FeatureArguments::Key(const DescriptorKind& kind) const {
  return fmt::format("{} {} {}", kind.name, max_features, upright);
}

}  // namespace lift_slam
