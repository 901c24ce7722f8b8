#pragma once

#include <memory>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/camera/undistortion.h"
#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/image/patch_alignment.h"

namespace lift_slam {

// What all frames of a run share: the ideal pinhole that features are undistorted to, the part of
// its image plane that the real image covers, and the feature extractor's scales and thresholds.
struct ViewModel {
  PinholeIntrinsics pinhole;
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;  // undistorted pixels covered
  ScaleLevels levels;
  ThresholdRange thresholds;
  int level_tolerance = 1;   // a point is looked for so many levels above and below its own
  std::vector<float> scale;  // by level, >= 1
  std::vector<double> inverse_variance;  // by level, 1 / px^2; sigma grows with the scale
  PatchAlignmentOptions alignment;
  std::shared_ptr<const UndistortionMap> undistortion;  // null: keypoints are undistorted already

  double InverseVariance(int level, bool is_aligned) const {
    const double factor = is_aligned ? alignment.sigma_factor : 1.0;
    return inverse_variance[static_cast<std::size_t>(level)] / (factor * factor);
  }

  bool Covers(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= min_x && pixel.x() < max_x && pixel.y() >= min_y && pixel.y() < max_y;
  }
};

// Bounds are those of the undistorted image.
ViewModel MakeViewModel(const PinholeIntrinsics& pinhole, const Eigen::Vector4d& min_max_x_y,
                        const ScaleLevels& levels, const ThresholdRange& thresholds);

}  // namespace lift_slam
