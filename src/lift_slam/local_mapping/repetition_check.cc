#include "lift_slam/local_mapping/repetition_check.h"

namespace lift_slam {

RepetitionCheck::RepetitionCheck(const Map& map, const KeyFrame& keyframe, double max_similarity)
    : map_(map),
      keyframe_(keyframe),
      max_similarity_(max_similarity),
      answers_(static_cast<std::size_t>(keyframe.features->size()), Answer::kUnknown) {}

bool RepetitionCheck::IsRepetitive(int feature, const KeyFrame& other) {
  if (!keyframe_.pyramid || max_similarity_ >= 1.0) return false;
  Answer& answer = answers_[static_cast<std::size_t>(feature)];
  if (answer == Answer::kUnknown) answer = Measure(feature, other) ? Answer::kYes : Answer::kNo;
  return answer == Answer::kYes;
}

bool RepetitionCheck::Measure(int feature, const KeyFrame& other) const {
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
                             scale) > max_similarity_;
}

}  // namespace lift_slam
