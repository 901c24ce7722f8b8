#include <algorithm>
#include <utility>

#include "lift_slam/map/map.h"
#include "lift_slam/util/check.h"

namespace lift_slam {

const std::optional<Map::Reference>& Map::ReplacementOf(KeyFrameId erased) const {
  LIFT_SLAM_CHECK(erased.valid() && erased.index() < replaced_by_.size(), "no keyframe {}",
                  erased.value);
  return replaced_by_[erased.index()];
}

std::unique_ptr<Map> Map::FromContents(std::shared_ptr<const ViewModel> view, Contents contents) {
  auto map = std::make_unique<Map>(std::move(view));
  map->keyframes_ = std::move(contents.keyframes);
  map->points_ = std::move(contents.points);
  map->replaced_by_ = std::move(contents.replaced_by);
  map->replaced_by_.resize(map->keyframes_.size());
  map->newest_keyframe_ = contents.newest_keyframe;
  for (const auto& keyframe : map->keyframes_) {
    if (!keyframe) continue;
    ++map->num_keyframes_;
    keyframe->map_points.assign(static_cast<std::size_t>(keyframe->features->size()), MapPointId());
  }
  if (!map->ReferencesEnd()) return nullptr;
  for (const auto& point : map->points_) {
    if (!point) continue;
    ++map->num_points_;
    if (!map->Connect(*point)) return nullptr;
  }
  return map;
}

bool Map::ReferencesEnd() const {
  enum class Way : std::uint8_t { kUnknown, kWalked, kEnds };
  std::vector<Way> ways(keyframes_.size(), Way::kUnknown);
  for (std::size_t start = 0; start < keyframes_.size(); ++start) {
    std::vector<std::size_t> walked;
    std::size_t at = start;
    while (ways[at] == Way::kUnknown && !keyframes_[at] && replaced_by_[at]) {
      ways[at] = Way::kWalked;
      walked.push_back(at);
      const KeyFrameId next = replaced_by_[at]->keyframe;
      if (!next.valid() || next.index() >= keyframes_.size()) return false;
      at = next.index();
    }
    if (ways[at] == Way::kWalked) return false;  // a circle
    for (const std::size_t passed : walked) ways[passed] = Way::kEnds;
  }
  return true;
}

bool Map::Connect(const MapPoint& point) {
  if (point.observations.empty()) return false;
  KeyFrameId previous;
  for (const MapPoint::Observation& observation : point.observations) {
    const KeyFrame* seen_by = FindKeyFrame(observation.keyframe);
    if (seen_by == nullptr || !(previous < observation.keyframe)) return false;
    previous = observation.keyframe;
    if (observation.feature < 0 || observation.feature >= seen_by->features->size()) return false;
    MapPointId& slot = mutable_keyframe(observation.keyframe)
                           .map_points[static_cast<std::size_t>(observation.feature)];
    if (slot.valid()) return false;
    slot = point.id;
    for (const MapPoint::Observation& other : point.observations) {
      if (other.keyframe < observation.keyframe) {
        covisibility_.AddShared(observation.keyframe, other.keyframe, +1);
      }
    }
  }
  return true;
}

}  // namespace lift_slam
