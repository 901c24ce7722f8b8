#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/features/feature_extractor.h"

namespace lift_slam {

struct ImagePairOptions {
  // Of best and second-best descriptor distance, both ways; 1: not asked.
  double max_ratio = 1.0;
  // Distance from the epipolar geometry (square root of the Sampson error) of an inlier, pixels.
  double max_error_px = 2.0;
  // Of the random samples for the essential matrix.
  std::uint64_t seed = 0;
};

struct ImagePairMatch {
  int a = -1, b = -1;  // feature indices
  float distance = 0.0F;
  bool is_inlier = false;
};

enum class EpipolarModel { kNone, kFundamental, kEssential };
inline constexpr std::string_view kEpipolarModelNames[] = {"none", "fundamental", "essential"};

struct ImagePairResult {
  std::vector<ImagePairMatch> matches;  // by distance, nearest first
  EpipolarModel model = EpipolarModel::kNone;
  int num_inliers = 0;
};

// Two images without any knowledge of where they were taken: mutual nearest descriptors, then the
// epipolar geometry that most of them fulfil. With a camera that is the essential matrix of its
// undistorted pixels, else the fundamental matrix. No model: no inliers. CheckError unless the
// descriptors are of one kind.
ImagePairResult MatchImagePair(const FeatureSet& a, const FeatureSet& b, const Camera* camera,
                               const ImagePairOptions& options);

}  // namespace lift_slam
