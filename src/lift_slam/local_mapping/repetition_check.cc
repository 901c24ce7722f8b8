#include "lift_slam/local_mapping/repetition_check.h"

#include <algorithm>

namespace lift_slam {

RepetitionCheck::RepetitionCheck(const Map& map, const KeyFrame& keyframe, double max_similarity)
    : map_(map),
      keyframe_(keyframe),
      max_similarity_(max_similarity),
      similarities_(static_cast<std::size_t>(keyframe.features->size())) {}

bool RepetitionCheck::IsRepetitive(int feature, const KeyFrame& other) {
  if (!keyframe_.pyramid || max_similarity_ >= 1.0) return false;
  std::optional<double>& similarity = similarities_[static_cast<std::size_t>(feature)];
  if (!similarity) similarity = Measure(feature, other);
  return *similarity > max_similarity_;
}

void RepetitionCheck::Relax(double max_similarity) {
  max_similarity_ = std::max(max_similarity_, max_similarity);
}

double RepetitionCheck::Measure(int feature, const KeyFrame& other) const {
  const PinholeIntrinsics& pinhole = map_.view().pinhole;
  const FrameFeatures& features = *keyframe_.features;
  // Towards the image of the other camera's centre; taken as straight where the lens bends it.
  const Eigen::Vector3d center = keyframe_.cam_from_world * other.Center();
  const Eigen::Vector2d ray = pinhole.Unproject(features.pixel(feature)).head<2>();
  const Eigen::Vector2d along = center.head<2>() - ray * center.z();
  const Eigen::Vector2d direction(along.x() * pinhole.fx, along.y() * pinhole.fy);
  const Keypoint& keypoint = features.keypoint(feature);
  const double scale = map_.view().scale[static_cast<std::size_t>(features.level(feature))];
  return SelfSimilarityAlong(*keyframe_.pyramid, Eigen::Vector2d(keypoint.x, keypoint.y), direction,
                             scale);
}

}  // namespace lift_slam
