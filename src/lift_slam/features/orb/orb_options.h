#pragma once

#include "lift_slam/util/options.h"

namespace lift_slam {

struct OrbOptions {
  // Features per image; 0: by image area, 2000 for 1241 x 376 (KITTI), within [1200, 6000]:
  // on small images fewer lose the camera in curves (a rendered drive of 752 x 228 pixels).
  int max_features = 0;
  // Pyramid: 8 levels 1.2 apart see a point over a distance ratio of 3.6.
  int num_levels = 8;
  double scale_factor = 1.2;
  // FAST contrast, grey levels. A cell without a corner above the first uses the second, so that
  // dim parts of the image keep their features.
  int fast_threshold = 20;
  int min_fast_threshold = 7;
  // Side of the cells of that rule, pixels of the level.
  int cell_size_px = 35;
  // Corner positions below a pixel. On KITTI 00 this takes the mean epipolar error of matches
  // between neighbouring frames from 0.52 to 0.32 pixels.
  bool subpixel = true;
  // Standard deviation of a position on the full-size level, pixels.
  double sigma_px = 1.0;
  // Threads that share the levels; the result does not depend on it.
  int num_threads = 1;

  void Visit(OptionVisitor& visitor);
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

// The number of features for this image: max_features, or the rule by area.
int FeatureCount(const OrbOptions& options, int width, int height);

}  // namespace lift_slam
