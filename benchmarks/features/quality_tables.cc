#include "benchmarks/features/quality_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "benchmarks/features/extractor_variants.h"
#include "benchmarks/features/markdown_table.h"
#include "lift_slam/features/image_pair.h"
#include "lift_slam/features/lift/keypoint_detection.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/lift/measurement/descriptor_distances.h"
#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/features/sift/sift_extractor.h"
#include "lift_slam/image/gamma.h"

namespace lift_slam {
namespace {

// Extracts each image once: sets share their first images.
class FeatureCache {
 public:
  explicit FeatureCache(FeatureExtractor& extractor) : extractor_(extractor) {}
  const FeatureSet& Of(const GrayImage& image) {
    const auto [entry, is_new] = features_.try_emplace(image.row(0));
    if (is_new) entry->second = extractor_.Extract(image);
    return entry->second;
  }

 private:
  FeatureExtractor& extractor_;
  std::map<const std::uint8_t*, FeatureSet> features_;
};

// Mean counts over the pairs of a set: "inliers (of the best 100)".
std::string MeanInliers(const ImageSet& set, FeatureExtractor& extractor, FeatureCache& cache) {
  double all = 0.0, best = 0.0;
  for (const auto& [a, b] : set.pairs) {
    const ImagePairResult result =
        MatchImagePair(cache.Of(a), extractor.Extract(ApplyGamma(b, set.gamma)),
                       set.camera ? &*set.camera : nullptr, {});
    all += result.num_inliers;
    const std::size_t count = std::min<std::size_t>(100, result.matches.size());
    best += static_cast<double>(
        std::ranges::count_if(std::span(result.matches).first(count), &ImagePairMatch::is_inlier));
  }
  const auto size = static_cast<double>(set.pairs.size());
  return fmt::format("{:.0f} ({:.0f})", all / size, best / size);
}

std::string InlierRow(const std::string& name, std::span<const ImageSet> sets,
                      const MakeExtractor& make) {
  const std::unique_ptr<FeatureExtractor> extractor = make();
  FeatureCache cache(*extractor);
  std::vector<std::string> cells{name};
  for (const ImageSet& set : sets) cells.push_back(MeanInliers(set, *extractor, cache));
  return RowShown(cells);
}

std::string DistanceCell(const DistanceSamples& samples) {
  const std::optional<double> rate = FalsePositiveRateAt95(samples);
  if (!rate) return "-";
  return fmt::format("{:.2f} / {:.1f}", 100.0 * *rate,
                     100.0 * static_cast<double>(samples.num_nearest_is_right) /
                         static_cast<double>(samples.matching.size()));
}

constexpr int kPairsPerImage = 300;  // of keypoints

// By the pixels of both images.
using FoundPairs = std::map<std::pair<const std::uint8_t*, const std::uint8_t*>, KeypointPairs>;

// The same pairs whatever the gamma: it changes the second images after SIFT has matched them.
std::vector<KeypointPairs> PairsOf(const ImageSet& set, FoundPairs& found) {
  std::vector<KeypointPairs> pairs;
  for (const auto& [a, b] : set.pairs) {
    const auto key = std::pair(a.row(0), b.row(0));
    const auto [entry, is_new] = found.try_emplace(key);
    if (is_new)
      entry->second = PairsBySift(a, b, set.camera ? &*set.camera : nullptr, kPairsPerImage);
    pairs.push_back(entry->second);
    pairs.back().image_b = ApplyGamma(b, set.gamma);
  }
  return pairs;
}

DistanceSamples Distances(std::span<const KeypointPairs> all, const Variant& variant,
                          const QualityOptions& options) {
  LiftNetworks networks(*variant.weights,
                        {.precision = variant.precision, .num_threads = options.num_threads});
  DistanceSamples samples;
  for (const KeypointPairs& pairs : all) {
    AppendDistances(pairs, DescribeKeypoints(pairs.image_a, pairs.in_a, variant.upright, networks),
                    DescribeKeypoints(pairs.image_b, pairs.in_b, variant.upright, networks),
                    samples);
  }
  return samples;
}

std::vector<LiftKeypoint> Best(std::vector<LiftKeypoint> keypoints) {
  std::ranges::stable_sort(keypoints, std::greater<>(), &LiftKeypoint::score);
  keypoints.resize(std::min<std::size_t>(500, keypoints.size()));
  return keypoints;
}

// Of the keypoints of a that come to lie within b (with the room of their patch), those found
// there.
double Repeatability(const GrayImage& image, const GrayImage& warped, const Eigen::Matrix3d& warp,
                     const KeypointFinder& find) {
  const std::vector<LiftKeypoint> in_a = Best(find(image)), in_b = Best(find(warped));
  int num_visible = 0, num_found = 0;
  for (const LiftKeypoint& k : in_a) {
    const LiftKeypoint place = Warped(k, warp);
    if (!LiesWithin(warped, place.x, place.y, kLiftHalfWidthSigmas * place.sigma)) continue;
    ++num_visible;
    num_found += std::ranges::any_of(in_b, [&](const LiftKeypoint& other) {
      return std::hypot(other.x - place.x, other.y - place.y) < 3.0;
    });
  }
  return num_visible == 0 ? 0.0 : static_cast<double>(num_found) / num_visible;
}

struct WarpKind {
  const char* name;
  WarpOptions options;
};

const WarpKind kWarpKinds[] = {
    {"mild warp",
     {.max_rotation_deg = 8, .max_scale = 1.15, .max_perspective = 0.1, .max_gamma = 1.2}},
    {"strong warp",
     {.max_rotation_deg = 20, .max_scale = 1.5, .max_perspective = 0.3, .max_gamma = 1.5}},
};

std::string RepeatabilityRow(const std::string& name, std::span<const ImageSet> sets,
                             const KeypointFinder& find) {
  std::vector<std::string> cells{name};
  for (const ImageSet& set : sets) {
    for (const WarpKind& kind : kWarpKinds) {
      Random random(5);  // the same warps for all rows
      double sum = 0.0;
      for (const auto& [image, unused] : set.pairs) {
        const Eigen::Matrix3d warp = RandomWarp(image, kind.options, random);
        sum += Repeatability(image, WarpedCopy(image, warp, kind.options, random), warp, find);
      }
      cells.push_back(fmt::format("{:.3f}", sum / static_cast<double>(set.pairs.size())));
    }
  }
  return RowShown(cells);
}

KeypointFinder FinderOf(const std::shared_ptr<FeatureExtractor>& extractor) {
  return [extractor](const GrayImage& image) {
    std::vector<LiftKeypoint> keypoints;
    for (const Keypoint& k : extractor->Extract(image).keypoints) {
      keypoints.push_back({k.x, k.y, extractor->scale_levels().Scale(k.level), k.response});
    }
    return keypoints;
  };
}

}  // namespace

std::string DescriptorTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                            const QualityOptions& options) {
  FoundPairs found_pairs;
  std::vector<std::vector<KeypointPairs>> pairs;
  std::vector<std::string> counts{"pairs of keypoints"};
  for (const ImageSet& set : sets) {
    pairs.push_back(PairsOf(set, found_pairs));
    std::size_t count = 0;
    for (const KeypointPairs& found : pairs.back()) count += found.in_a.size();
    counts.push_back(std::to_string(count));
  }
  std::string table = Header("FPR95, % / nearest is right, %", sets) + Row(counts);
  for (const Variant& variant : Variants(all, options)) {
    std::vector<std::string> cells{variant.name};
    for (const auto& of_set : pairs) {
      cells.push_back(DistanceCell(Distances(of_set, variant, options)));
    }
    table += RowShown(cells);
  }
  return table;
}

std::string MatchingTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                          const QualityOptions& options) {
  std::string table = Header("inliers (of the best 100)", sets);
  for (const auto& [name, make] : Extractors(all, options)) table += InlierRow(name, sets, make);
  return table;
}

std::string RepeatabilityTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                               const QualityOptions& options) {
  std::vector<std::string> names{"found again within 3 px"};
  for (const ImageSet& set : sets) {
    for (const WarpKind& kind : kWarpKinds) names.push_back(set.name + ", " + kind.name);
  }
  std::string table = Header(names);
  QualityOptions many = options;
  many.max_features = 500;
  for (const char* name : {"ORB", "SIFT"}) {
    table += RepeatabilityRow(name, sets, FinderOf(Baseline(name, many)()));
  }
  for (const auto& [name, weights] : all) {
    LiftNetworks networks(weights, {.num_threads = many.num_threads});
    KeypointDetector detector({});
    table += RepeatabilityRow(
        name, sets, [&](const GrayImage& image) { return detector.Detect(image, networks); });
  }
  return table;
}

std::string KeypointChoiceTable(const NamedWeights& weights, std::span<const ImageSet> sets,
                                const QualityOptions& options) {
  std::string table = Header("inliers (of the best 100)", sets);
  const auto row = [&](const std::string& name, const LiftExtractorOptions& lift) {
    table += InlierRow(name, sets, [&] { return CreateLiftExtractor(weights.weights, lift); });
  };
  LiftExtractorOptions lift;
  lift.max_features = options.max_features;
  lift.precision = options.precisions.front();
  lift.upright = !weights.weights.orientation;
  lift.num_threads = options.num_threads;
  const double usual = lift.candidate_ratio;
  for (const double ratio : {1.0, 1.3, 2.0, 4.0}) {
    lift.candidate_ratio = ratio;
    row(fmt::format("candidate ratio {:g}", ratio), lift);
  }
  lift.candidate_ratio = usual;
  lift.detector.nms_levels = 2;
  row(fmt::format("ratio {:g}, maxima over 2 levels", usual), lift);
  lift.detector.nms_levels = 1;
  lift.detector.first_level = 5;
  row(fmt::format("ratio {:g}, without the first octave", usual), lift);
  return table;
}

std::string PrecisionTable(std::span<const NamedWeights> all, std::span<const std::uint8_t> patches,
                           const QualityOptions& options) {
  std::string table = Header({"difference from float32", "largest of a value",
                              "of a descriptor, mean", "of a descriptor, largest"});
  for (const Variant& variant : Variants(all, options)) {
    if (variant.precision == nn::Precision::kFloat32 ||
        variant.upright != !variant.weights->orientation) {
      continue;
    }
    LiftNetworks exact(*variant.weights, {});
    LiftNetworks rounded(*variant.weights, {.precision = variant.precision});
    const auto expected = exact.DescribePatches(patches), found = rounded.DescribePatches(patches);
    float largest = 0.0F;
    double sum = 0.0, worst = 0.0, squared = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const float difference = found[i] - expected[i];
      largest = std::max(largest, std::abs(difference));
      squared += static_cast<double>(difference) * static_cast<double>(difference);
      if (i % 128 != 127) continue;
      sum += std::sqrt(squared);
      worst = std::max(worst, std::sqrt(squared));
      squared = 0.0;
    }
    const double mean = sum / std::max(1.0, static_cast<double>(found.size() / 128));
    table += Row({variant.name, fmt::format("{:.4f}", largest), fmt::format("{:.4f}", mean),
                  fmt::format("{:.4f}", worst)});
  }
  return table;
}

}  // namespace lift_slam
