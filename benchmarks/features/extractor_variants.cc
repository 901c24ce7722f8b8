#include "benchmarks/features/extractor_variants.h"

#include <fmt/format.h>

#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/features/sift/sift_extractor.h"

namespace lift_slam {

std::vector<Variant> Variants(std::span<const NamedWeights> all, const QualityOptions& options) {
  std::vector<Variant> variants;
  for (const auto& [name, weights] : all) {
    for (const bool upright : {true, false}) {
      if (!upright && !weights.orientation) continue;
      for (const nn::Precision wanted : options.precisions) {
        const nn::Precision precision =
            LiftNetworks(weights, {.precision = wanted}).precision().used;
        const bool is_possible = wanted == nn::Precision::kAuto || precision == wanted;
        if (!is_possible) continue;  // the CPU or the file cannot
        variants.push_back(
            {&weights, precision, upright,
             fmt::format("{} {}{}", name, upright ? "upright " : "", nn::Name(precision))});
      }
    }
  }
  return variants;
}

MakeExtractor Baseline(const std::string& name, const QualityOptions& options) {
  if (name == "SIFT") {
    return [=] {
      return std::make_unique<SiftExtractor>(SiftOptions{.max_features = options.max_features});
    };
  }
  return [=] {
    OrbOptions orb;
    orb.max_features = options.max_features;
    orb.num_threads = options.num_threads;
    return CreateOrbExtractor(orb);
  };
}

std::vector<ExtractorVariant> Extractors(std::span<const NamedWeights> all,
                                         const QualityOptions& options) {
  std::vector<ExtractorVariant> extractors;
  for (const char* name : {"ORB", "SIFT"}) extractors.push_back({name, Baseline(name, options)});
  for (const Variant& variant : Variants(all, options)) {
    LiftExtractorOptions lift;
    lift.max_features = options.max_features;
    lift.precision = variant.precision;
    lift.upright = variant.upright;
    lift.num_threads = options.num_threads;
    extractors.push_back({variant.name, [weights = variant.weights, lift] {
                            return CreateLiftExtractor(*weights, lift);
                          }});
  }
  return extractors;
}

}  // namespace lift_slam
