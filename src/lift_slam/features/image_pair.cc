#include "lift_slam/features/image_pair.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/features/brute_force_matcher.h"
#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/epipolar.h"
#include "lift_slam/geometry/fundamental_matrix.h"
#include "lift_slam/geometry/two_view_models.h"

namespace lift_slam {
namespace {

constexpr int kMinInliers = 8;  // fewer fulfil the geometry of any five or seven of them

// Positions of the matches that have one (undistortion may fail), and which those are.
struct MatchedPositions {
  std::vector<std::size_t> matches;
  std::vector<Eigen::Vector2d> in_a, in_b;
};

Eigen::Vector2d Position(const FeatureSet& features, int index) {
  const Keypoint& k = features.keypoints[static_cast<std::size_t>(index)];
  return {k.x, k.y};
}

MatchedPositions Positions(const FeatureSet& a, const FeatureSet& b, const Camera* camera,
                           const std::vector<ImagePairMatch>& matches) {
  const auto undistorted = [&](const Eigen::Vector2d& pixel) {
    return camera == nullptr ? std::optional(pixel) : camera->Undistort(pixel);
  };
  MatchedPositions positions;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto in_a = undistorted(Position(a, matches[i].a));
    const auto in_b = undistorted(Position(b, matches[i].b));
    if (!in_a || !in_b) continue;
    positions.matches.push_back(i);
    positions.in_a.push_back(*in_a);
    positions.in_b.push_back(*in_b);
  }
  return positions;
}

int CountInliers(std::span<const NormalizedMatch> matches, const Eigen::Matrix3d& essential) {
  return static_cast<int>(std::ranges::count_if(matches, [&](const NormalizedMatch& m) {
    return SquaredSampsonError(essential, m.in_image1, m.in_image2) <
           kChiSquare95With1Dof * m.sigma * m.sigma;
  }));
}

// The best five-point sample, polished on its inliers; for pixels, K^-T E K^-1.
std::optional<Eigen::Matrix3d> FindEssential(const MatchedPositions& positions,
                                             const PinholeIntrinsics& pinhole,
                                             const ImagePairOptions& options) {
  const double focal_px = 0.5 * (pinhole.fx + pinhole.fy);
  const double sigma = options.max_error_px / (std::sqrt(kChiSquare95With1Dof) * focal_px);
  std::vector<NormalizedMatch> matches;
  for (std::size_t i = 0; i < positions.in_a.size(); ++i) {
    matches.push_back({pinhole.Unproject(positions.in_a[i]).head<2>(),
                       pinhole.Unproject(positions.in_b[i]).head<2>(), sigma});
  }
  Random random(options.seed);
  const RansacLimits limits{.min_iterations = 50, .max_iterations = 2000, .confidence = 0.9999};
  const auto found = FindEssentialMatrices(matches, limits, 1, random);
  if (found.empty()) return std::nullopt;
  Eigen::Matrix3d essential = found.front().matrix;
  const Eigen::Matrix3d refined = EssentialMatrix(
      RefineRelativePose(matches, DecomposeEssential(essential).front(), kChiSquare95With1Dof, 20));
  if (CountInliers(matches, refined) >= CountInliers(matches, essential)) essential = refined;
  const Eigen::Matrix3d normalized_from_pixel = pinhole.Matrix().inverse();
  return normalized_from_pixel.transpose() * essential * normalized_from_pixel;
}

}  // namespace

ImagePairResult MatchImagePair(const FeatureSet& a, const FeatureSet& b, const Camera* camera,
                               const ImagePairOptions& options) {
  ImagePairResult result;
  for (const DescriptorMatch& match :
       MatchMutualNearest(a.descriptors, b.descriptors, static_cast<float>(options.max_ratio))) {
    result.matches.push_back({match.a, match.b, match.distance});
  }
  std::ranges::stable_sort(result.matches, {}, &ImagePairMatch::distance);
  const MatchedPositions positions = Positions(a, b, camera, result.matches);
  const auto model = camera != nullptr ? FindEssential(positions, camera->pinhole, options)
                                       : FindFundamentalMatrix(positions.in_a, positions.in_b,
                                                               options.max_error_px);
  if (!model) return result;
  for (std::size_t i = 0; i < positions.matches.size(); ++i) {
    const double error = SquaredSampsonError(*model, positions.in_a[i], positions.in_b[i]);
    if (!(error < options.max_error_px * options.max_error_px)) continue;
    result.matches[positions.matches[i]].is_inlier = true;
    ++result.num_inliers;
  }
  if (result.num_inliers < kMinInliers) {
    for (ImagePairMatch& match : result.matches) match.is_inlier = false;
    result.num_inliers = 0;
    return result;
  }
  result.model = camera != nullptr ? EpipolarModel::kEssential : EpipolarModel::kFundamental;
  return result;
}

}  // namespace lift_slam
