#include "lift_slam/map/view_model.h"

#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

// Levels within which a feature's scale repeats: one for ORB's 1.2, two for LIFT's 1.15.
int LevelTolerance(double scale_factor) {
  constexpr double kScaleTolerance = 1.35;
  return std::max(1, static_cast<int>(std::log(kScaleTolerance) / std::log(scale_factor)));
}

}  // namespace

ViewModel MakeViewModel(const PinholeIntrinsics& pinhole, const Eigen::Vector4d& min_max_x_y,
                        const ScaleLevels& levels, const ThresholdRange& thresholds) {
  ViewModel model;
  model.pinhole = pinhole;
  model.min_x = min_max_x_y[0];
  model.max_x = min_max_x_y[1];
  model.min_y = min_max_x_y[2];
  model.max_y = min_max_x_y[3];
  model.levels = levels;
  model.thresholds = thresholds;
  model.level_tolerance = LevelTolerance(levels.scale_factor);
  for (int level = 0; level < levels.num_levels; ++level) {
    const double scale = levels.Scale(level);
    const double sigma = levels.sigma_px * scale;
    model.scale.push_back(static_cast<float>(scale));
    model.inverse_variance.push_back(1.0 / (sigma * sigma));
  }
  return model;
}

}  // namespace lift_slam
