#include "apps/pair_features.h"

#include <fmt/format.h>

#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/features/sift/sift_extractor.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

NamedExtractor MakeLift(const PairFeatures& features) {
  const LiftWeights weights = ReadLiftWeightsOrDefault(features.weights);
  if (!weights.orientation && !features.lift.upright) {
    throw InputError(fmt::format("the weights '{}' have no orientation network; leave --turned out",
                                 weights.name));
  }
  auto extractor = std::make_unique<LiftExtractor>(weights, features.lift);
  std::string title =
      fmt::format("LIFT ({}{}, {})", weights.name, features.lift.upright ? ", upright" : "",
                  nn::Name(extractor->precision().used));
  return {std::move(extractor), std::move(title)};
}

}  // namespace

NamedExtractor MakeExtractor(const PairFeatures& features) {
  if (features.name == "lift") return MakeLift(features);
  if (features.name != "orb" && features.name != "sift") {
    throw InputError(
        fmt::format("--features '{}' is unknown, expected lift, orb or sift", features.name));
  }
  if (!features.weights.empty()) {
    throw InputError(fmt::format("--weights are for --features lift, not {}", features.name));
  }
  if (features.name == "sift") {
    const SiftOptions options{.max_features = features.lift.max_features};
    return {std::make_unique<SiftExtractor>(options), "SIFT"};
  }
  OrbOptions options;
  options.max_features = features.lift.max_features;
  options.num_threads = features.lift.num_threads;
  return {CreateOrbExtractor(options), "ORB"};
}

GrayImage ReadImageOrThrow(const std::filesystem::path& path) {
  std::string why;
  const std::optional<GrayImage> image = ReadGrayImage(path, &why);
  if (!image) throw InputError(fmt::format("image '{}' cannot be read: {}", path.string(), why));
  return *image;
}

FeatureSet ExtractNamed(FeatureExtractor& extractor, const GrayImage& image,
                        const std::filesystem::path& path) {
  try {
    return extractor.Extract(image);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace lift_slam
