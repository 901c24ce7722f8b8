#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/geometry/sim3.h"
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

  struct Reference;
  // All that a map is made of, as a file holds it. The keyframes' map_points are empty: the points'
  // observations say the same.
  struct Contents;
  // The map with these contents; nothing when they contradict one another.
  static std::unique_ptr<Map> FromContents(std::shared_ptr<const ViewModel> view,
                                           Contents contents);

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
  // Ids ever given out.
  std::size_t num_keyframe_ids() const { return keyframes_.size(); }
  std::size_t num_point_ids() const { return points_.size(); }
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
  // The step of ResolveReference from an erased keyframe to the one that took its place, which may
  // be erased itself.
  const std::optional<Reference>& ReplacementOf(KeyFrameId erased) const;

  // Poses and points have been moved and scaled: `scale_of_keyframe`, by id, is the factor of the
  // lengths in each keyframe's camera frame. What erased keyframes left behind follows.
  void ScaleReferences(const std::vector<double>& scale_of_keyframe);

  // By how much Absorb moved the ids of the other map up.
  struct IdOffset {
    int keyframes = 0, points = 0;
  };
  // Takes over all of another map, moved and scaled into this one's world. Nothing is fused.
  IdOffset Absorb(Map&& other, const Sim3d& world_from_other_world);

  // Normal, distance range and descriptor from the present observations.
  void UpdateAppearance(MapPointId id);
  // Only normal and distance range: after positions have moved.
  void UpdateViewingRange(MapPointId id);

  // Depths of the keyframe's map points in its camera, ascending.
  std::vector<double> SceneDepths(KeyFrameId id) const;

 private:
  KeyFrame& mutable_keyframe(KeyFrameId id);
  void AbsorbKeyFrames(Map& other, const IdOffset& offset, const Sim3d& world_from_other_world);
  void AbsorbPoints(Map& other, const IdOffset& offset, const Sim3d& world_from_other_world);
  void LetGoOfOldImages();
  // For FromContents: false when the contents are wrong.
  bool ReferencesEnd() const;
  bool Connect(const MapPoint& point);
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

struct Map::Contents {
  std::vector<std::unique_ptr<KeyFrame>> keyframes;   // by id; null: erased
  std::vector<std::unique_ptr<MapPoint>> points;      // by id; null: erased
  std::vector<std::optional<Reference>> replaced_by;  // by keyframe id
  KeyFrameId newest_keyframe;
};

}  // namespace lift_slam
