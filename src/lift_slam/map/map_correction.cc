#include <utility>

#include "lift_slam/map/map.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

void MoveUp(KeyFrameId& id, const Map::IdOffset& offset) {
  if (id.valid()) id.value += offset.keyframes;
}

void MoveUp(MapPointId& id, const Map::IdOffset& offset) {
  if (id.valid()) id.value += offset.points;
}

}  // namespace

void Map::ScaleReferences(const std::vector<double>& scale_of_keyframe) {
  for (std::size_t i = 0; i < replaced_by_.size(); ++i) {
    if (!replaced_by_[i]) continue;
    const auto reference = ResolveReference(KeyFrameId(static_cast<std::int32_t>(i)));
    if (!reference) continue;
    const std::size_t standing = reference->keyframe.index();
    LIFT_SLAM_CHECK(standing < scale_of_keyframe.size(), "no scale of keyframe {}", standing);
    replaced_by_[i]->cam_from_keyframe.translation *= scale_of_keyframe[standing];
  }
}

Map::IdOffset Map::Absorb(Map&& other, const Sim3d& world_from_other_world) {
  const IdOffset offset{static_cast<int>(keyframes_.size()), static_cast<int>(points_.size())};
  AbsorbKeyFrames(other, offset, world_from_other_world);
  AbsorbPoints(other, offset, world_from_other_world);
  covisibility_.Absorb(other.covisibility_, offset.keyframes);
  num_keyframes_ += std::exchange(other.num_keyframes_, 0);
  num_points_ += std::exchange(other.num_points_, 0);
  if (other.newest_keyframe_.valid()) {
    newest_keyframe_ = other.newest_keyframe_;
    MoveUp(newest_keyframe_, offset);
  }
  LetGoOfOldImages();
  return offset;
}

void Map::AbsorbKeyFrames(Map& other, const IdOffset& offset, const Sim3d& world_from_other) {
  for (auto& keyframe : other.keyframes_) {
    if (keyframe) {
      MoveUp(keyframe->id, offset);
      for (MapPointId& point : keyframe->map_points) MoveUp(point, offset);
      keyframe->cam_from_world =
          Inverse(TransformWorld(Inverse(keyframe->cam_from_world), world_from_other));
    }
    keyframes_.push_back(std::move(keyframe));
  }
  for (auto& reference : other.replaced_by_) {
    if (reference) {
      MoveUp(reference->keyframe, offset);
      reference->cam_from_keyframe.translation *= world_from_other.scale;
    }
    replaced_by_.push_back(std::move(reference));
  }
}

void Map::AbsorbPoints(Map& other, const IdOffset& offset, const Sim3d& world_from_other) {
  for (auto& point : other.points_) {
    if (point) {
      MoveUp(point->id, offset);
      MoveUp(point->created_by, offset);
      for (MapPoint::Observation& o : point->observations) MoveUp(o.keyframe, offset);
      if (point->anchor) MoveUp(point->anchor->keyframe, offset);
      point->position = world_from_other * point->position;
      point->normal = world_from_other.rotation * point->normal;
      point->min_distance *= world_from_other.scale;
      point->max_distance *= world_from_other.scale;
    }
    points_.push_back(std::move(point));
  }
}

void Map::LetGoOfOldImages() {
  const std::int32_t end = newest_keyframe_.value - kKeyFramesWithImage + 1;
  for (std::int32_t i = 0; i < end; ++i) {
    const auto& keyframe = keyframes_[static_cast<std::size_t>(i)];
    if (keyframe) keyframe->pyramid.reset();
  }
}

}  // namespace lift_slam
