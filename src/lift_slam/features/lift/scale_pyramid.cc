#include "lift_slam/features/lift/scale_pyramid.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/image/resize.h"

namespace lift_slam {

std::vector<ScaleLevel> MakeScaleLevels(int width, int height, int first_level) {
  // In training a keypoint of sigma covers 24 sigma with 48 pixels, corners aligned.
  constexpr double kPixelsPerSigma = 23.5 / 12.0;
  constexpr double kMinSize = 26.0;
  std::vector<ScaleLevel> levels;
  for (int k = first_level; k < kLiftNumLevels; ++k) {
    const double sigma = std::exp2(static_cast<double>(k) / kLiftLevelsPerOctave);
    const double factor = kPixelsPerSigma / sigma;
    if (factor * std::min(width, height) <= kMinSize) break;
    levels.push_back({.sigma = sigma,
                      .factor = factor,
                      .width = static_cast<int>(std::lround(width * factor)),
                      .height = static_cast<int>(std::lround(height * factor)),
                      .full_width = width,
                      .full_height = height});
  }
  return levels;
}

LevelPosition ToFullSize(const ScaleLevel& level, LevelPosition position, LevelCoordinates how) {
  if (how == LevelCoordinates::kOriginal) {
    return {position.x / level.factor, position.y / level.factor};
  }
  return {(position.x + 0.5) * level.full_width / level.width - 0.5,
          (position.y + 0.5) * level.full_height / level.height - 0.5};
}

LevelPosition ToLevel(const ScaleLevel& from, const ScaleLevel& to, LevelPosition position,
                      LevelCoordinates how) {
  if (how == LevelCoordinates::kOriginal) {
    return {position.x * (to.width - 1) / (from.width - 1),
            position.y * (to.height - 1) / (from.height - 1)};
  }
  return {(position.x + 0.5) * to.width / from.width - 0.5,
          (position.y + 0.5) * to.height / from.height - 0.5};
}

void ScorePyramid::Compute(const GrayImage& image, int first_level, LiftNetworks& networks) {
  const std::vector<ScaleLevel> shapes =
      MakeScaleLevels(image.width(), image.height(), first_level);
  images_.resize(shapes.size());
  levels_.resize(shapes.size());
  networks.team().ForEach(static_cast<int>(shapes.size()), [&](int, int piece) {
    const auto i = static_cast<std::size_t>(piece);
    ResizeInto(image, shapes[i].width, shapes[i].height, images_[i]);
  });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const ScoreMap map = networks.DetectorScores(images_[i]);
    ScoreLevel& level = levels_[i];
    level.shape = shapes[i];
    level.border = kLiftDetectorBorder;
    level.width = map.width;
    level.height = map.height;
    level.scores.assign(map.scores.begin(), map.scores.end());
  }
}

}  // namespace lift_slam
