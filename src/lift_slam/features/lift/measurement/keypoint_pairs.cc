#include "lift_slam/features/lift/measurement/keypoint_pairs.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>

#include "lift_slam/features/image_pair.h"
#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/features/sift/sift_extractor.h"
#include "lift_slam/image/gamma.h"
#include "lift_slam/image/noise.h"
#include "lift_slam/image/warp.h"

namespace lift_slam {
namespace {

constexpr double kMinBlobSigma = 1.5;
constexpr double kSamePlaceSigmas = 0.5;
constexpr double kMaxSizeRatio = 1.25;

bool HasPatch(const GrayImage& image, const LiftKeypoint& k) {
  return LiesWithin(image, k.x, k.y, kLiftHalfWidthSigmas * k.sigma);
}

LiftKeypoint ToLift(const Keypoint& k, const ScaleLevels& levels) {
  return {k.x, k.y, levels.Scale(k.level), k.response};
}

bool IsNear(const LiftKeypoint& a, const LiftKeypoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < kSamePlaceSigmas * std::min(a.sigma, b.sigma);
}

bool IsNearAny(const LiftKeypoint& keypoint, const std::vector<LiftKeypoint>& others) {
  return std::ranges::any_of(others, [&](const auto& other) { return IsNear(keypoint, other); });
}

void SortByScore(std::vector<LiftKeypoint>& keypoints) {
  std::ranges::stable_sort(keypoints, std::greater<>(), &LiftKeypoint::score);
}

// The nearest of the keypoints at this place and of this size.
std::optional<std::size_t> FindAt(const LiftKeypoint& place,
                                  const std::vector<LiftKeypoint>& keypoints) {
  std::optional<std::size_t> best;
  double best_distance = 0.0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const LiftKeypoint& k = keypoints[i];
    const double ratio = std::max(k.sigma / place.sigma, place.sigma / k.sigma);
    if (!IsNear(place, k) || ratio > kMaxSizeRatio) continue;
    const double distance = std::hypot(k.x - place.x, k.y - place.y);
    if (best && distance >= best_distance) continue;
    best = i;
    best_distance = distance;
  }
  return best;
}

double UniformFactor(double largest, Random& random) {
  return std::exp(random.Uniform(-std::log(largest), std::log(largest)));
}

}  // namespace

std::vector<LiftKeypoint> FindBlobs(const GrayImage& image) {
  SiftExtractor extractor({.max_features = 3000, .contrast_threshold = 0.02});
  std::vector<LiftKeypoint> found, blobs;
  for (const Keypoint& k : extractor.Extract(image).keypoints) {
    found.push_back(ToLift(k, extractor.scale_levels()));
  }
  SortByScore(found);
  for (const LiftKeypoint& k : found) {
    if (k.sigma >= kMinBlobSigma && HasPatch(image, k) && !IsNearAny(k, blobs)) blobs.push_back(k);
  }
  return blobs;
}

Eigen::Matrix3d RandomWarp(const GrayImage& image, const WarpOptions& options, Random& random) {
  const double half_width = 0.5 * image.width(), half_height = 0.5 * image.height();
  const double angle = options.max_rotation_deg * random.Uniform(-1, 1) * std::numbers::pi / 180.0;
  const double scale = UniformFactor(options.max_scale, random);
  const double tilt_x = options.max_perspective * random.Uniform(-1, 1) / half_width;
  const double tilt_y = options.max_perspective * random.Uniform(-1, 1) / half_height;
  const double cosine = scale * std::cos(angle), sine = scale * std::sin(angle);
  Eigen::Matrix3d to_middle, about_middle;
  to_middle << 1, 0, -half_width, 0, 1, -half_height, 0, 0, 1;
  about_middle << cosine, -sine, 0, sine, cosine, 0, tilt_x, tilt_y, 1;
  return to_middle.inverse() * about_middle * to_middle;
}

GrayImage WarpedCopy(const GrayImage& image, const Eigen::Matrix3d& warped_from_image,
                     const WarpOptions& options, Random& random) {
  const double gamma = UniformFactor(options.max_gamma, random);
  const GrayImage changed = ApplyGamma(WarpImage(image, warped_from_image), gamma);
  return AddNoise(changed, options.noise_sigma_grey, random);
}

// The size by the area that a small square becomes: the root of the Jacobian's determinant, which
// for a homography H is det(H) / w^3.
LiftKeypoint Warped(const LiftKeypoint& keypoint, const Eigen::Matrix3d& warped_from_image) {
  const Eigen::Vector3d there = warped_from_image * Eigen::Vector3d(keypoint.x, keypoint.y, 1.0);
  const double area = std::abs(warped_from_image.determinant() / std::pow(there.z(), 3));
  return {there.x() / there.z(), there.y() / there.z(), keypoint.sigma * std::sqrt(area),
          keypoint.score};
}

KeypointPairs PairsByWarp(const GrayImage& image, const KeypointFinder& find, int max_pairs,
                          const WarpOptions& options, Random& random) {
  const Eigen::Matrix3d warp = RandomWarp(image, options, random);
  KeypointPairs pairs{image, WarpedCopy(image, warp, options, random), {}, {}};
  std::vector<LiftKeypoint> in_a = find(pairs.image_a), in_b = find(pairs.image_b);
  SortByScore(in_a);
  for (const LiftKeypoint& k : in_a) {
    if (std::ssize(pairs.in_a) >= max_pairs) break;
    const LiftKeypoint place = Warped(k, warp);
    if (!HasPatch(pairs.image_b, place) || IsNearAny(k, pairs.in_a)) continue;
    const std::optional<std::size_t> match = FindAt(place, in_b);
    if (!match) continue;
    pairs.in_a.push_back(k);
    pairs.in_b.push_back(in_b[*match]);
    in_b.erase(in_b.begin() + static_cast<std::ptrdiff_t>(*match));
  }
  return pairs;
}

KeypointPairs PairsBySift(const GrayImage& image_a, const GrayImage& image_b, const Camera* camera,
                          int max_pairs) {
  SiftExtractor extractor({.max_features = 3000, .contrast_threshold = 0.02});
  const FeatureSet a = extractor.Extract(image_a), b = extractor.Extract(image_b);
  KeypointPairs all{image_a, image_b, {}, {}};
  for (const ImagePairMatch& match : MatchImagePair(a, b, camera, {.max_ratio = 0.8}).matches) {
    const auto keypoint = [&](const FeatureSet& features, int index) {
      return ToLift(features.keypoints[static_cast<std::size_t>(index)], extractor.scale_levels());
    };
    const LiftKeypoint in_a = keypoint(a, match.a), in_b = keypoint(b, match.b);
    if (!match.is_inlier || std::min(in_a.sigma, in_b.sigma) < kMinBlobSigma ||
        !HasPatch(image_a, in_a) || !HasPatch(image_b, in_b) || IsNearAny(in_a, all.in_a) ||
        IsNearAny(in_b, all.in_b)) {
      continue;
    }
    all.in_a.push_back(in_a);
    all.in_b.push_back(in_b);
  }
  // Evenly from the whole list, which is sorted by distance.
  KeypointPairs pairs{image_a, image_b, {}, {}};
  const std::size_t size = all.in_a.size();
  const std::size_t count = std::min(size, static_cast<std::size_t>(max_pairs));
  for (std::size_t i = 0; i < count; ++i) {
    pairs.in_a.push_back(all.in_a[i * size / count]);
    pairs.in_b.push_back(all.in_b[i * size / count]);
  }
  return pairs;
}

}  // namespace lift_slam
