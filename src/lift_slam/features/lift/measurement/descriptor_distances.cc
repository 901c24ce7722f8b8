#include "lift_slam/features/lift/measurement/descriptor_distances.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/patch_cutter.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kElsewhereSigmas = 2.0;
constexpr float kNoDistance = std::numeric_limits<float>::max();

bool IsElsewhere(const LiftKeypoint& a, const LiftKeypoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y) >= kElsewhereSigmas * std::max(a.sigma, b.sigma);
}

float Distance(std::span<const float> a, std::span<const float> b, std::size_t i, std::size_t j) {
  using Values = Eigen::Map<const Eigen::Matrix<float, kLiftDescriptorSize, 1>>;
  constexpr std::size_t kSize = kLiftDescriptorSize;
  return (Values(a.data() + kSize * i) - Values(b.data() + kSize * j)).norm();
}

}  // namespace

std::vector<float> DescribeKeypoints(const GrayImage& image,
                                     std::span<const LiftKeypoint> keypoints, bool upright,
                                     LiftNetworks& networks) {
  if (keypoints.empty()) return {};
  PatchCutter cutter;
  cutter.SetImage(image);
  std::vector<float> angles;
  if (!upright) {
    const auto found = networks.OrientPatches(cutter.Cut(keypoints, {}, networks.team()));
    angles.assign(found.begin(), found.end());
  }
  const auto values = networks.DescribePatches(cutter.Cut(keypoints, angles, networks.team()));
  return {values.begin(), values.end()};
}

void AppendDistances(const KeypointPairs& pairs, std::span<const float> a, std::span<const float> b,
                     DistanceSamples& samples) {
  const std::size_t count = pairs.in_a.size();
  LIFT_SLAM_CHECK(
      pairs.in_b.size() == count && a.size() == count * kLiftDescriptorSize && b.size() == a.size(),
      "{} and {} values for {} pairs", a.size(), b.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const float matching = Distance(a, b, i, i);
    float nearest = kNoDistance;
    for (std::size_t j = 0; j < count; ++j) {
      if (!IsElsewhere(pairs.in_b[i], pairs.in_b[j])) continue;
      samples.wrong.push_back(Distance(a, b, i, j));
      nearest = std::min(nearest, samples.wrong.back());
    }
    samples.matching.push_back(matching);
    if (nearest < kNoDistance) samples.nearest_wrong.push_back(nearest);
    if (matching < nearest) ++samples.num_nearest_is_right;
  }
}

float Quantile(std::vector<float> samples, double share) {
  if (samples.empty()) return 0.0F;
  const double place = share * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(samples.begin(), at, samples.end());
  if (below + 1 >= samples.size()) return *at;
  const float above = *std::min_element(at + 1, samples.end());
  return *at + static_cast<float>(place - static_cast<double>(below)) * (above - *at);
}

std::optional<double> FalsePositiveRateAt95(const DistanceSamples& samples) {
  if (samples.matching.empty() || samples.wrong.empty()) return {};
  const float limit = Quantile(samples.matching, 0.95);
  const auto num_near =
      std::ranges::count_if(samples.wrong, [&](float distance) { return distance <= limit; });
  return static_cast<double>(num_near) / static_cast<double>(samples.wrong.size());
}

DistanceQuantiles Quantiles(const DistanceSamples& samples) {
  constexpr std::array<double, 5> kShares{0.05, 0.25, 0.5, 0.75, 0.95};
  DistanceQuantiles quantiles;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    quantiles.matching[i] = Quantile(samples.matching, kShares[i]);
    quantiles.nearest_wrong[i] = Quantile(samples.nearest_wrong, kShares[i]);
  }
  return quantiles;
}

}  // namespace lift_slam
