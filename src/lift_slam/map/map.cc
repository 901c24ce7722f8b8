#include "lift_slam/map/map.h"

#include <algorithm>

#include "lift_slam/util/check.h"

namespace lift_slam {

KeyFrameId Map::AddKeyFrame(const Frame& frame) {
  const KeyFrameId id(static_cast<std::int32_t>(keyframes_.size()));
  auto keyframe = std::make_unique<KeyFrame>();
  keyframe->id = id;
  keyframe->frame_index = frame.frame_index;
  keyframe->timestamp_ns = frame.timestamp_ns;
  keyframe->features = frame.features;
  keyframe->cam_from_world = frame.cam_from_world;
  keyframe->map_points.resize(frame.map_points.size());
  keyframe->pyramid = frame.pyramid;
  keyframes_.push_back(std::move(keyframe));
  replaced_by_.emplace_back();
  newest_keyframe_ = id;
  ++num_keyframes_;
  for (std::size_t i = 0; i < frame.map_points.size(); ++i) {
    const MapPoint* point = FindPoint(frame.map_points[i]);
    if (point != nullptr && point->FeatureIn(id) < 0) {
      AddObservation(point->id, id, static_cast<int>(i));
      SetAlignedPixel(point->id, id, frame.AlignedPixel(static_cast<int>(i)));
    }
  }
  const std::int32_t without_image = id.value - kKeyFramesWithImage;
  if (without_image >= 0 && keyframes_[static_cast<std::size_t>(without_image)]) {
    keyframes_[static_cast<std::size_t>(without_image)]->pyramid.reset();
  }
  return id;
}

MapPointId Map::AddPoint(const Eigen::Vector3d& position_in_world, KeyFrameId created_by) {
  const MapPointId id(static_cast<std::int32_t>(points_.size()));
  auto point = std::make_unique<MapPoint>();
  point->id = id;
  point->position = position_in_world;
  point->created_by = created_by;
  points_.push_back(std::move(point));
  ++num_points_;
  return id;
}

const KeyFrame* Map::FindKeyFrame(KeyFrameId id) const {
  return id.valid() && id.index() < keyframes_.size() ? keyframes_[id.index()].get() : nullptr;
}

const MapPoint* Map::FindPoint(MapPointId id) const {
  return id.valid() && id.index() < points_.size() ? points_[id.index()].get() : nullptr;
}

MapPoint* Map::FindPoint(MapPointId id) {
  return id.valid() && id.index() < points_.size() ? points_[id.index()].get() : nullptr;
}

const KeyFrame& Map::keyframe(KeyFrameId id) const {
  const KeyFrame* keyframe = FindKeyFrame(id);
  LIFT_SLAM_CHECK(keyframe != nullptr, "keyframe {} is not in the map", id.value);
  return *keyframe;
}

KeyFrame& Map::mutable_keyframe(KeyFrameId id) {
  LIFT_SLAM_CHECK(FindKeyFrame(id) != nullptr, "keyframe {} is not in the map", id.value);
  return *keyframes_[id.index()];
}

const MapPoint& Map::point(MapPointId id) const {
  const MapPoint* point = FindPoint(id);
  LIFT_SLAM_CHECK(point != nullptr, "map point {} is not in the map", id.value);
  return *point;
}

MapPoint& Map::point(MapPointId id) {
  MapPoint* point = FindPoint(id);
  LIFT_SLAM_CHECK(point != nullptr, "map point {} is not in the map", id.value);
  return *point;
}

std::vector<KeyFrameId> Map::KeyFrameIds() const {
  std::vector<KeyFrameId> ids;
  for (const auto& keyframe : keyframes_) {
    if (keyframe) ids.push_back(keyframe->id);
  }
  return ids;
}

std::vector<MapPointId> Map::PointIds() const {
  std::vector<MapPointId> ids;
  for (const auto& point : points_) {
    if (point) ids.push_back(point->id);
  }
  return ids;
}

std::vector<MapPointId> Map::PointsSeenBy(const std::vector<KeyFrameId>& keyframes) const {
  std::vector<MapPointId> points;
  for (const KeyFrameId id : keyframes) {
    for (const MapPointId point : keyframe(id).map_points) {
      if (point.valid()) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void Map::SetPose(KeyFrameId id, const Rigid3d& cam_from_world) {
  mutable_keyframe(id).cam_from_world = cam_from_world;
}

void Map::ShareWithObservers(const MapPoint& point, KeyFrameId keyframe, int change) {
  for (const MapPoint::Observation& other : point.observations) {
    if (other.keyframe != keyframe) covisibility_.AddShared(keyframe, other.keyframe, change);
  }
}

void Map::AddObservation(MapPointId point_id, KeyFrameId keyframe_id, int feature) {
  MapPoint& observed = point(point_id);
  MapPointId& slot = mutable_keyframe(keyframe_id).map_points.at(static_cast<std::size_t>(feature));
  LIFT_SLAM_CHECK(!slot.valid() && observed.FeatureIn(keyframe_id) < 0,
                  "point {} or feature {} of keyframe {} is taken", point_id.value, feature,
                  keyframe_id.value);
  ShareWithObservers(observed, keyframe_id, +1);
  slot = point_id;
  const auto place = std::lower_bound(
      observed.observations.begin(), observed.observations.end(), keyframe_id,
      [](const MapPoint::Observation& o, KeyFrameId id) { return o.keyframe < id; });
  observed.observations.insert(
      place, {keyframe_id, feature, keyframe(keyframe_id).features->undistorted(feature)});
}

void Map::SetAlignedPixel(MapPointId point_id, KeyFrameId keyframe_id,
                          const std::optional<Eigen::Vector2f>& pixel) {
  for (MapPoint::Observation& observation : point(point_id).observations) {
    if (observation.keyframe != keyframe_id) continue;
    observation.is_aligned = pixel.has_value();
    observation.pixel =
        pixel ? *pixel : keyframe(keyframe_id).features->undistorted(observation.feature);
    return;
  }
  LIFT_SLAM_CHECK(false, "keyframe {} does not see point {}", keyframe_id.value, point_id.value);
}

void Map::RemoveObservation(MapPointId point_id, KeyFrameId keyframe_id) {
  MapPoint& observed = point(point_id);
  const int feature = observed.FeatureIn(keyframe_id);
  LIFT_SLAM_CHECK(feature >= 0, "keyframe {} does not see point {}", keyframe_id.value,
                  point_id.value);
  std::erase_if(observed.observations,
                [&](const MapPoint::Observation& o) { return o.keyframe == keyframe_id; });
  ShareWithObservers(observed, keyframe_id, -1);
  mutable_keyframe(keyframe_id).map_points[static_cast<std::size_t>(feature)] = MapPointId();
  if (observed.num_observations() < 2) ErasePoint(point_id);
}

void Map::ErasePoint(MapPointId id) {
  MapPoint& erased = point(id);
  while (!erased.observations.empty()) {
    const MapPoint::Observation last = erased.observations.back();
    erased.observations.pop_back();
    ShareWithObservers(erased, last.keyframe, -1);
    mutable_keyframe(last.keyframe).map_points[static_cast<std::size_t>(last.feature)] =
        MapPointId();
  }
  points_[id.index()].reset();
  --num_points_;
}

void Map::MergePoints(MapPointId from, MapPointId into) {
  LIFT_SLAM_CHECK(from != into, "point {} into itself", from.value);
  const std::vector<MapPoint::Observation> moved = point(from).observations;
  const int visible = point(from).num_visible, found = point(from).num_found;
  ErasePoint(from);
  for (const MapPoint::Observation& observation : moved) {
    if (point(into).FeatureIn(observation.keyframe) < 0) {
      AddObservation(into, observation.keyframe, observation.feature);
    }
  }
  point(into).num_visible += visible;
  point(into).num_found += found;
  UpdateAppearance(into);
}

void Map::EraseKeyFrame(KeyFrameId id) {
  const auto neighbors = covisibility_.Neighbors(id, 1, 1);
  if (!neighbors.empty()) {
    const Rigid3d& neighbor_pose = keyframe(neighbors.front().keyframe).cam_from_world;
    replaced_by_[id.index()] = {neighbors.front().keyframe,
                                keyframe(id).cam_from_world * Inverse(neighbor_pose)};
  }
  const std::vector<MapPointId> seen = keyframe(id).map_points;
  for (const MapPointId point_id : seen) {
    if (point_id.valid()) RemoveObservation(point_id, id);
  }
  covisibility_.Erase(id);
  keyframes_[id.index()].reset();
  --num_keyframes_;
}

std::optional<Map::Reference> Map::ResolveReference(KeyFrameId id) const {
  Reference reference{id, Rigid3d()};
  while (FindKeyFrame(reference.keyframe) == nullptr) {
    const KeyFrameId erased = reference.keyframe;
    if (!erased.valid() || erased.index() >= replaced_by_.size() || !replaced_by_[erased.index()]) {
      return std::nullopt;
    }
    const Reference& next = *replaced_by_[erased.index()];
    reference = {next.keyframe, reference.cam_from_keyframe * next.cam_from_keyframe};
  }
  return reference;
}

std::vector<double> Map::SceneDepths(KeyFrameId id) const {
  const KeyFrame& viewer = keyframe(id);
  std::vector<double> depths;
  for (const MapPointId point_id : viewer.map_points) {
    if (point_id.valid()) depths.push_back((viewer.cam_from_world * point(point_id).position).z());
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

}  // namespace lift_slam
