#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lift_slam/features/lift/peak_refinement.h"
#include "lift_slam/image/pyramid.h"
#include "lift_slam/nn/worker_team.h"

namespace lift_slam {

// Patches of 64 x 64 around keypoints, 6 sigma to each side, sampled from the image halved as often
// as keeps neighbouring samples within 1.5 pixels (which is once from sigma 7.9 on). Keeps its
// memory from image to image.
class PatchCutter {
 public:
  void SetImage(const GrayImage& image);

  // One patch a keypoint, one after the other; until the next call. `angles_rad` has one a
  // keypoint, or is empty for upright patches.
  std::span<const std::uint8_t> Cut(std::span<const LiftKeypoint> keypoints,
                                    std::span<const float> angles_rad, nn::WorkerTeam& team);

 private:
  void CutOne(const LiftKeypoint& keypoint, float angle_rad, std::span<std::uint8_t> patch) const;

  ImagePyramid pyramid_;
  std::vector<std::uint8_t> patches_;
};

}  // namespace lift_slam
