#include "lift_slam/slam/feature_options.h"

#include <fmt/format.h>

#include <utility>

#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/image/image_library.h"
#include "lift_slam/nn/executor.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {
namespace {

// Without what does not change the features themselves.
std::string IdentityOf(LiftExtractorOptions options, const LiftExtractor& extractor) {
  const LiftExtractorOptions defaults;
  options.num_threads = defaults.num_threads;
  options.sigma_px = defaults.sigma_px;
  options.low_threshold = defaults.low_threshold;
  options.high_threshold = defaults.high_threshold;
  options.precision = extractor.precision().used;
  // The detector's version: to be counted up when a change of it finds other keypoints.
  return fmt::format("lift, detector 2, {}, {}\n{}\n{}", ImageLibraryVersion(),
                     nn::NetworkLibraryVersion(), extractor.descriptor_kind().name,
                     OptionsToYaml(MakeOptionRoot(options)));
}

}  // namespace

std::unique_ptr<FeatureExtractor> CreateFeatureExtractor(const FeatureOptions& options,
                                                         std::shared_ptr<FeatureCache> cache) {
  if (options.type == FeatureType::kOrb) {
    auto orb = CreateOrbExtractor(options.orb);
    if (!cache) return orb;
    return WithCache(std::move(orb), OrbIdentity(options.orb), std::move(cache));
  }
  auto lift =
      std::make_unique<LiftExtractor>(ReadLiftWeightsOrDefault(options.lift_weights), options.lift);
  if (!cache) return lift;
  std::string identity = IdentityOf(options.lift, *lift);
  return WithCache(std::move(lift), std::move(identity), std::move(cache));
}

}  // namespace lift_slam
