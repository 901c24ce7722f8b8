#pragma once

#include <vector>

#include "lift_slam/features/lift/peak_refinement.h"
#include "lift_slam/features/lift/scale_pyramid.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct LiftDetectorOptions {
  // Levels have sigma 2^(k / 5), k = first_level to 20. 5 leaves the up-sampled octave out: a
  // quarter of the time, but no keypoints below sigma 2.
  int first_level = 0;
  // Levels above and below that a maximum must beat. The authors' 2 leaves about 1600 keypoints on
  // an image of KITTI, too few for 2000 spread ones.
  int nms_levels = 1;
  // Largest ratio of the curvatures of the score along two directions.
  double max_edge_ratio = 10.0;
  LevelCoordinates coordinates = LevelCoordinates::kExact;

  void Visit(OptionVisitor& visitor);
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

// Maxima of the scores in space and scale, refined; level by level in raster order, all strengths.
// The same for any number of threads.
std::vector<LiftKeypoint> FindKeypoints(std::span<const ScoreLevel> levels,
                                        const LiftDetectorOptions& options, nn::WorkerTeam& team);

// LIFT's detector on a whole image (paper sec. 4.1 of LIFT; no smoothing of the scores).
class KeypointDetector {
 public:
  explicit KeypointDetector(const LiftDetectorOptions& options);

  // Without those whose square of 6 sigma to each side (not turned) leaves the image.
  std::vector<LiftKeypoint> Detect(const GrayImage& image, LiftNetworks& networks);

 private:
  LiftDetectorOptions options_;
  ScorePyramid pyramid_;
};

}  // namespace lift_slam
