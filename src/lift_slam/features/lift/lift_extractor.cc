#include "lift_slam/features/lift/lift_extractor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/spread_selection.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

LiftExtractorOptions Checked(const LiftWeights& weights, const LiftExtractorOptions& options) {
  options.Check();
  if (!options.upright && !weights.orientation) {
    throw InputError(fmt::format(
        "the weights '{}' have no orientation network; set option 'lift.upright' to true",
        weights.name));
  }
  return options;
}

LiftNetworkOptions NetworkOptions(const LiftExtractorOptions& options) {
  LiftNetworkOptions result;
  result.precision = options.precision;
  result.num_threads = options.num_threads > 0 ? options.num_threads : NumHardwareThreads();
  return result;
}

// Their numbers stand for weights that were never saved.
std::string HashOf(LiftWeights weights) {
  if (!weights.sha256.empty()) return weights.sha256;
  std::string bytes;
  for (const LiftParameter& parameter : Parameters(weights)) {
    bytes.append(reinterpret_cast<const char*>(parameter.values.data()),
                 parameter.values.size_bytes());
  }
  return Sha256Hex(bytes);
}

// The nearest wrong distances are those of a whole image; a search around a prediction meets only a
// few of the wrong ones, and bounds this much looser gave a little more accurate runs.
constexpr float kWindowFactor = 1.3F;

int LevelOf(double sigma) {
  const auto level = std::lround(kLiftLevelsPerOctave * std::log2(sigma));
  return static_cast<int>(std::clamp<long>(level, 0, kLiftNumLevels - 1));
}

}  // namespace

DescriptorKind LiftDescriptorKind(const LiftWeights& weights, bool upright) {
  return {"lift:" + HashOf(weights) + (upright ? ":upright" : ""), DescriptorMetric::kL2,
          kLiftDescriptorSize};
}

ThresholdRange LiftThresholds(const LiftWeights& weights, const LiftExtractorOptions& options) {
  ThresholdRange range{{2.0F, 3.0F}, {1.0F, 2.0F}, {2.0F, 3.0F}};
  if (weights.distances) {
    const auto& [matching, wrong] = *weights.distances;
    const auto [low, middle] = std::minmax({matching[4], kWindowFactor * wrong[2]});
    range = {{low, middle}, {low, middle}, {middle, std::max(middle, kWindowFactor * wrong[4])}};
  }
  // Between strict and loose lie most wrong matches. A wrong new point has nothing yet that speaks
  // against it, and along a repeated texture such points take the scale with them.
  range.moves_new_points = false;
  if (options.low_threshold > 0.0) range.fixed.low = static_cast<float>(options.low_threshold);
  if (options.high_threshold > 0.0) range.fixed.high = static_cast<float>(options.high_threshold);
  range.fixed.high = std::max(range.fixed.low, range.fixed.high);
  return range;
}

LiftExtractor::LiftExtractor(const LiftWeights& weights, const LiftExtractorOptions& options)
    : options_(Checked(weights, options)),
      networks_(weights, NetworkOptions(options)),
      detector_(options.detector),
      scale_levels_{kLiftNumLevels, std::exp2(1.0 / kLiftLevelsPerOctave), options.sigma_px},
      kind_(LiftDescriptorKind(weights, options.upright)),
      thresholds_(LiftThresholds(weights, options)) {}

FeatureSet LiftExtractor::Extract(const GrayImage& image) {
  if (std::min(image.width(), image.height()) < kLiftPatchSize) {
    throw InputError(fmt::format("the image has {} x {} pixels; LIFT needs at least {} x {}",
                                 image.width(), image.height(), kLiftPatchSize, kLiftPatchSize));
  }
  const std::vector<LiftKeypoint> keypoints = DetectSpread(image);
  cutter_.SetImage(image);
  const std::vector<float> angles = Orient(keypoints);
  const auto values = networks_.DescribePatches(cutter_.Cut(keypoints, angles, networks_.team()));
  FeatureSet features{{}, Descriptors(kind_, keypoints.size())};
  features.keypoints.reserve(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    features.keypoints.push_back({.x = static_cast<float>(keypoints[i].x),
                                  .y = static_cast<float>(keypoints[i].y),
                                  .angle_rad = angles.empty() ? 0.0F : angles[i],
                                  .response = keypoints[i].score,
                                  .level = LevelOf(keypoints[i].sigma)});
  }
  if (!values.empty()) {
    std::memcpy(features.descriptors.mutable_data(), values.data(), values.size_bytes());
  }
  return features;
}

std::string LiftExtractor::Notice() const {
  const nn::PrecisionChoice& choice = precision();
  if (choice.reason.empty()) return {};
  return fmt::format("LIFT's descriptors in {}: {}", nn::Name(choice.used), choice.reason);
}

std::vector<LiftKeypoint> LiftExtractor::DetectSpread(const GrayImage& image) {
  std::vector<LiftKeypoint> all = detector_.Detect(image, networks_);
  const double num_candidates = options_.max_features * options_.candidate_ratio;
  if (options_.max_features > 0 && static_cast<double>(all.size()) > num_candidates) {
    std::stable_sort(all.begin(), all.end(), [](const LiftKeypoint& a, const LiftKeypoint& b) {
      return a.score > b.score;
    });
    all.resize(static_cast<std::size_t>(num_candidates));
  }
  std::vector<ScoredPoint> points;
  points.reserve(all.size());
  for (const LiftKeypoint& k : all) {
    points.push_back({static_cast<float>(k.x), static_cast<float>(k.y), k.score});
  }
  const int count =
      options_.max_features > 0 ? options_.max_features : static_cast<int>(all.size());
  std::vector<std::size_t> selected =
      SelectSpread({0, 0, image.width(), image.height()}, count, points);
  std::sort(selected.begin(), selected.end(), [&](std::size_t a, std::size_t b) {
    if (all[a].y != all[b].y) return all[a].y < all[b].y;
    return all[a].x != all[b].x ? all[a].x < all[b].x : a < b;
  });
  std::vector<LiftKeypoint> keypoints;
  keypoints.reserve(selected.size());
  for (const std::size_t i : selected) keypoints.push_back(all[i]);
  return keypoints;
}

// None for upright patches.
std::vector<float> LiftExtractor::Orient(const std::vector<LiftKeypoint>& keypoints) {
  if (options_.upright || keypoints.empty()) return {};
  const auto angles = networks_.OrientPatches(cutter_.Cut(keypoints, {}, networks_.team()));
  return {angles.begin(), angles.end()};
}

std::unique_ptr<FeatureExtractor> CreateLiftExtractor(const LiftWeights& weights,
                                                      const LiftExtractorOptions& options) {
  return std::make_unique<LiftExtractor>(weights, options);
}

}  // namespace lift_slam
