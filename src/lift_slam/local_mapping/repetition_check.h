#pragma once

#include <optional>
#include <vector>

#include "lift_slam/image/self_similarity.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// Whether features of a keyframe look the same again elsewhere along their epipolar line: posts of
// a fence, stacked tyres, kerb stones, the side of a road. At a steady speed a match with the wrong
// one of them agrees with a camera that moves otherwise in all later frames too, so that neither
// the reprojection error nor further views give it away. Looks in the image itself, for not every
// post is found as a feature.
class RepetitionCheck {
 public:
  // Features more alike than `max_similarity` (a correlation) are repetitive; 1 or more: none.
  RepetitionCheck(const Map& map, const KeyFrame& keyframe, double max_similarity);

  // Along the epipolar line of `other`. False when the keyframe's image is not kept. Asked again
  // for the same feature it gives the first answer: the neighbours of a keyframe lie in about the
  // same direction, or see it from the same side.
  bool IsRepetitive(int feature, const KeyFrame& other);
  // From now on only what is more alike than this.
  void Relax(double max_similarity);

 private:
  double Measure(int feature, const KeyFrame& other) const;

  const Map& map_;
  const KeyFrame& keyframe_;
  double max_similarity_;
  std::vector<std::optional<double>> similarities_;  // by feature, measured so far
};

}  // namespace lift_slam
