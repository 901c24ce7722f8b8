#include "lift_slam/features/lift/patch_cutter.h"

#include <algorithm>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/patch_sampling.h"

namespace lift_slam {
namespace {

constexpr std::size_t kPatchPixels = std::size_t{kLiftPatchSize} * kLiftPatchSize;

}  // namespace

void PatchCutter::SetImage(const GrayImage& image) {
  RebuildPyramid(image, {.num_levels = 4, .scale_factor = 2.0, .min_size_px = 2}, pyramid_);
}

std::span<const std::uint8_t> PatchCutter::Cut(std::span<const LiftKeypoint> keypoints,
                                               std::span<const float> angles_rad,
                                               nn::WorkerTeam& team) {
  constexpr std::size_t kPiece = 32;  // keypoints that a thread takes at a time
  const std::size_t size = keypoints.size() * kPatchPixels;
  if (patches_.size() < size) patches_.resize(size);
  const auto pieces = static_cast<int>((keypoints.size() + kPiece - 1) / kPiece);
  team.ForEach(pieces, [&](int, int piece) {
    const std::size_t begin = static_cast<std::size_t>(piece) * kPiece;
    for (std::size_t i = begin; i < std::min(begin + kPiece, keypoints.size()); ++i) {
      CutOne(keypoints[i], angles_rad.empty() ? 0.0F : angles_rad[i],
             std::span(patches_).subspan(i * kPatchPixels, kPatchPixels));
    }
  });
  return std::span(patches_).first(size);
}

void PatchCutter::CutOne(const LiftKeypoint& keypoint, float angle_rad,
                         std::span<std::uint8_t> patch) const {
  constexpr double kMaxStepPx = 1.5;
  const double half_width = kLiftHalfWidthSigmas * keypoint.sigma;
  const double step = 2.0 * half_width / (kLiftPatchSize - 1);
  std::size_t i = 0;
  while (i + 1 < pyramid_.size() && step > kMaxStepPx * pyramid_[i].scale_x) ++i;
  // The sizes of a level are rounded: its pixels are square to within 1 in its shorter side.
  const PyramidLevel& level = pyramid_[i];
  SamplePatch(level.image,
              {.x = (keypoint.x + 0.5) / level.scale_x - 0.5,
               .y = (keypoint.y + 0.5) / level.scale_y - 0.5,
               .half_width_px = half_width / level.scale_x,
               .angle_rad = angle_rad},
              kLiftPatchSize, patch);
}

}  // namespace lift_slam
