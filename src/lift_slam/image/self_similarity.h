#pragma once

#include <Eigen/Core>

#include "lift_slam/image/pyramid.h"

namespace lift_slam {

struct SelfSimilarityOptions {
  double min_offset_px = 4.0;  // nearer patches overlap too much to be another thing; patch pixels
  double reach_px = 80.0;      // how far to look, patch pixels
};

// The largest normalised correlation (zero mean, in [-1, 1]) between the patch around `center` and
// those of the same image and scale along the line through it, on both sides. Near 1 in a row of
// fence posts, or along an edge: such a patch cannot be told from its neighbours when it is looked
// for along this line. `center` in pixels of the full-size image, `direction` of any length but
// zero; one pixel of the patch is `scale` pixels of the full-size image. Ends at the image's
// border; -1 when nothing can be compared, 1 when the patch has no contrast.
double SelfSimilarityAlong(const ImagePyramid& image, const Eigen::Vector2d& center,
                           const Eigen::Vector2d& direction, double scale,
                           const SelfSimilarityOptions& options = {});

}  // namespace lift_slam
