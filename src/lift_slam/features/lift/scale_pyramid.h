#pragma once

#include <limits>
#include <span>
#include <vector>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// How a position on a level is carried to the image and to other levels.
enum class LevelCoordinates {
  kExact,     // by pixel centres, as the resampling does; scores of other levels interpolated
  kOriginal,  // as the authors' code: off by half of (full-size pixels per pixel, minus one)
};
inline constexpr std::string_view kLevelCoordinatesNames[] = {"exact", "original"};

// The image in one of its sizes: large enough that a keypoint of this sigma has the size that the
// detector was trained for. Pixel (0, 0) is the centre of the top-left pixel.
struct ScaleLevel {
  double sigma = 1.0;   // full-size pixels
  double factor = 1.0;  // nominal pixels per full-size pixel; above 1 for sigma < 1.96
  int width = 0, height = 0;
  int full_width = 0, full_height = 0;
};

inline constexpr int kLiftLevelsPerOctave = 5;
inline constexpr int kLiftNumLevels = 21;

// Levels first_level to 20 with sigma 2^(k / 5), as far as the shorter side of the level is more
// than 26 pixels.
std::vector<ScaleLevel> MakeScaleLevels(int width, int height, int first_level);

struct LevelPosition {
  double x = 0.0, y = 0.0;
};
LevelPosition ToFullSize(const ScaleLevel& level, LevelPosition position, LevelCoordinates how);
LevelPosition ToLevel(const ScaleLevel& from, const ScaleLevel& to, LevelPosition position,
                      LevelCoordinates how);

// A level with its detector scores.
struct ScoreLevel {
  static constexpr float kNoScore = -std::numeric_limits<float>::infinity();

  ScaleLevel shape;
  // Scores exist for columns [border, border + width), rows [border, border + height) of the level.
  int border = 0, width = 0, height = 0;
  std::vector<float> scores;  // row by row; at least width * height

  const float* row(int y) const {
    return scores.data() + static_cast<std::size_t>(y - border) * static_cast<std::size_t>(width) -
           border;
  }
  // Of a pixel of the level; kNoScore where there is none, also outside the level.
  float At(int x, int y) const {
    const bool has_score = x >= border && y >= border && x < border + width && y < border + height;
    return has_score ? row(y)[x] : kNoScore;
  }
};

// Resizes the image (bilinearly, without smoothing, each level from the image itself) and scores
// every level. Keeps its memory from image to image.
class ScorePyramid {
 public:
  void Compute(const GrayImage& image, int first_level, LiftNetworks& networks);
  std::span<const ScoreLevel> levels() const { return levels_; }

 private:
  std::vector<GrayImage> images_;
  std::vector<ScoreLevel> levels_;
};

}  // namespace lift_slam
