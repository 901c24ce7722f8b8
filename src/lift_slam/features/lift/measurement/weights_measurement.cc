#include "lift_slam/features/lift/measurement/weights_measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/features/lift/keypoint_detection.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/measurement/descriptor_distances.h"
#include "lift_slam/features/lift/patch_cutter.h"
#include "lift_slam/image/gamma.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// Draws `count` of the elements, or all in another order.
std::vector<LiftKeypoint> DrawSome(std::vector<LiftKeypoint> all, std::size_t count,
                                   Random& random) {
  count = std::min(count, all.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int other = random.UniformInt(static_cast<int>(i), static_cast<int>(all.size()) - 1);
    std::swap(all[i], all[static_cast<std::size_t>(other)]);
  }
  all.resize(count);
  return all;
}

constexpr int kMinContrastGrey = 8;  // on flat ground keypoints are rounding

// Without patches of less contrast.
void AppendPatches(const GrayImage& image, std::span<const LiftKeypoint> keypoints,
                   LiftNetworks& networks, std::vector<std::uint8_t>& patches) {
  PatchCutter cutter;
  cutter.SetImage(image);
  const auto cut = cutter.Cut(keypoints, {}, networks.team());
  constexpr std::size_t kSize = std::size_t{kLiftPatchSize} * kLiftPatchSize;
  for (std::size_t at = 0; at < cut.size(); at += kSize) {
    const auto patch = cut.subspan(at, kSize);
    const auto [darkest, brightest] = std::ranges::minmax_element(patch);
    if (*brightest - *darkest < kMinContrastGrey) continue;
    patches.insert(patches.end(), patch.begin(), patch.end());
  }
}

}  // namespace

std::vector<float> MeasureRangesOnImages(const LiftWeights& weights,
                                         std::span<const GrayImage> images, int num_patches,
                                         std::uint64_t seed) {
  LiftNetworks networks(weights, {});
  KeypointDetector detector({});
  Random random(seed);
  const std::size_t per_image = (static_cast<std::size_t>(num_patches) + images.size() - 1) /
                                std::max<std::size_t>(1, images.size());
  std::vector<std::uint8_t> patches;
  for (const GrayImage& image : images) {
    const auto keypoints = DrawSome(detector.Detect(image, networks), per_image, random);
    const std::span<const LiftKeypoint> all(keypoints);
    const std::size_t half = all.size() / 2;
    AppendPatches(image, all.first(half), networks, patches);
    const GrayImage changed = ApplyGamma(image, std::exp2(random.Uniform(-1, 1)));
    AppendPatches(changed, all.subspan(half), networks, patches);
  }
  if (patches.empty()) throw InputError("the images have no keypoints to measure the ranges on");
  return MeasureDescriptorRanges(weights, patches);
}

MeasuredDistances MeasureDistances(const LiftWeights& weights, std::span<const GrayImage> images,
                                   std::span<const std::pair<GrayImage, GrayImage>> pairs,
                                   const DistanceMeasurement& options) {
  if (!options.upright && !weights.orientation) {
    throw InputError(
        fmt::format("the weights '{}' have no orientation network; say --upright", weights.name));
  }
  LiftNetworks networks(weights, {.num_threads = options.num_threads});
  KeypointDetector detector({});
  const auto find = [&](const GrayImage& image) { return detector.Detect(image, networks); };
  DistanceSamples samples;
  const auto append = [&](const KeypointPairs& found) {
    const auto describe = [&](const GrayImage& image, std::span<const LiftKeypoint> keypoints) {
      return DescribeKeypoints(image, keypoints, options.upright, networks);
    };
    AppendDistances(found, describe(found.image_a, found.in_a), describe(found.image_b, found.in_b),
                    samples);
  };
  Random random(options.seed);
  for (const GrayImage& image : images) {
    for (int i = 0; i < options.warps_per_image; ++i) {
      append(PairsByWarp(image, find, options.max_pairs, options.warp, random));
    }
  }
  for (const auto& [a, b] : pairs) append(PairsBySift(a, b, nullptr, options.max_pairs));
  constexpr std::size_t kMinPairs = 100;
  if (std::min(samples.matching.size(), samples.nearest_wrong.size()) < kMinPairs) {
    throw InputError(fmt::format(
        "only {} keypoints were found again; at least {} are needed: give more or larger images",
        samples.matching.size(), kMinPairs));
  }
  return {Quantiles(samples), samples.matching.size()};
}

}  // namespace lift_slam
