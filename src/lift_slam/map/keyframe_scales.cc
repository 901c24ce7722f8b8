#include "lift_slam/map/keyframe_scales.h"

#include "lift_slam/util/median.h"

namespace lift_slam {

KeyFrameScales::KeyFrameScales(const Map& map) {
  if (map.num_keyframes() > 0) depths_.resize(map.newest_keyframe().index() + 1);
  for (const KeyFrameId id : map.KeyFrameIds()) {
    const KeyFrame& keyframe = map.keyframe(id);
    for (const MapPointId point : keyframe.map_points) {
      if (!point.valid()) continue;
      depths_[id.index()].push_back(
          {point, (keyframe.cam_from_world * map.point(point).position).z()});
    }
  }
}

std::vector<double> KeyFrameScales::ChangesIn(const Map& map) const {
  std::vector<double> changes(depths_.size(), 1.0);
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    const auto reference = map.ResolveReference(KeyFrameId(static_cast<std::int32_t>(i)));
    if (!reference) continue;
    const KeyFrame& keyframe = map.keyframe(reference->keyframe);
    std::vector<double> ratios;
    for (const Depth& before : depths_[keyframe.id.index()]) {
      const MapPoint* point = map.FindPoint(before.point);
      if (point == nullptr) continue;
      const double depth = (keyframe.cam_from_world * point->position).z();
      if (depth > 0.0 && before.depth > 0.0) ratios.push_back(depth / before.depth);
    }
    if (!ratios.empty()) changes[i] = Median(std::move(ratios));
  }
  return changes;
}

}  // namespace lift_slam
