#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/map/covisibility_graph.h"
#include "lift_slam/map/frame.h"
#include "lift_slam/map/map_point.h"
#include "lift_slam/map/view_model.h"

namespace lift_slam {

// Keyframes, map points and the covisibility graph of one map, owned by value and consistent with
// one another after every call. Erased ids are never used again and look up to nothing.
// Not thread-safe: one stage at a time works on it.
class Map {
 public:
  explicit Map(std::shared_ptr<const ViewModel> view) : view_(std::move(view)) {}

  const ViewModel& view() const { return *view_; }
  std::shared_ptr<const ViewModel> shared_view() const { return view_; }
  const CovisibilityGraph& covisibility() const { return covisibility_; }

  // Keyframes whose image is kept: the newest ones, for new observations in them.
  static constexpr int kKeyFramesWithImage = 20;

  // The frame's matches become observations; matches with erased points are dropped.
  KeyFrameId AddKeyFrame(const Frame& frame);
  MapPointId AddPoint(const Eigen::Vector3d& position_in_world, KeyFrameId created_by);

  // Nothing when erased or never made.
  const KeyFrame* FindKeyFrame(KeyFrameId id) const;
  const MapPoint* FindPoint(MapPointId id) const;
  MapPoint* FindPoint(MapPointId id);
  // CheckError when erased or never made.
  const KeyFrame& keyframe(KeyFrameId id) const;
  const MapPoint& point(MapPointId id) const;
  MapPoint& point(MapPointId id);

  // Ids of what is in the map, ascending.
  std::vector<KeyFrameId> KeyFrameIds() const;
  std::vector<MapPointId> PointIds() const;
  // Without repetition, ascending.
  std::vector<MapPointId> PointsSeenBy(const std::vector<KeyFrameId>& keyframes) const;
  int num_keyframes() const { return num_keyframes_; }
  int num_points() const { return num_points_; }
  KeyFrameId newest_keyframe() const { return newest_keyframe_; }

  void SetPose(KeyFrameId id, const Rigid3d& cam_from_world);

  // Connects a point and a keyframe's feature; both must be free of each other.
  void AddObservation(MapPointId point, KeyFrameId keyframe, int feature);
  // Where alignment found the point in the keyframe; nothing: back to the detected pixel.
  void SetAlignedPixel(MapPointId point, KeyFrameId keyframe,
                       const std::optional<Eigen::Vector2f>& pixel);
  // Disconnects them; a point left with fewer than two observations is erased.
  void RemoveObservation(MapPointId point, KeyFrameId keyframe);
  void ErasePoint(MapPointId id);
  // Moves the observations of `from` to `into` where the keyframe does not see `into` yet, then
  // erases `from`. What alignment found for them is forgotten.
  void MergePoints(MapPointId from, MapPointId into);
  // Erases a redundant keyframe; frames that refer to it go on through `PoseRelativeTo`.
  void EraseKeyFrame(KeyFrameId id);

  // The keyframe itself, or for an erased one the neighbour that stands for it, with the pose
  // cam_from_neighbour at the time of erasure. Nothing when no neighbour was left.
  struct Reference {
    KeyFrameId keyframe;
    Rigid3d cam_from_keyframe;
  };
  std::optional<Reference> ResolveReference(KeyFrameId id) const;

  // Normal, distance range and descriptor from the present observations.
  void UpdateAppearance(MapPointId id);
  // Only normal and distance range: after positions have moved.
  void UpdateViewingRange(MapPointId id);

  // Depths of the keyframe's map points in its camera, ascending.
  std::vector<double> SceneDepths(KeyFrameId id) const;

 private:
  KeyFrame& mutable_keyframe(KeyFrameId id);
  void ShareWithObservers(const MapPoint& point, KeyFrameId keyframe, int change);

  std::shared_ptr<const ViewModel> view_;
  std::vector<std::unique_ptr<KeyFrame>> keyframes_;   // by id; null: erased
  std::vector<std::unique_ptr<MapPoint>> points_;      // by id; null: erased
  std::vector<std::optional<Reference>> replaced_by_;  // by keyframe id, for erased ones
  CovisibilityGraph covisibility_;
  KeyFrameId newest_keyframe_;
  int num_keyframes_ = 0;
  int num_points_ = 0;
};

}  // namespace lift_slam
