#pragma once

#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// A map's depths before something moves it, to see afterwards how the units around each keyframe
// have changed: frames kept relative to a keyframe must follow.
class KeyFrameScales {
 public:
  explicit KeyFrameScales(const Map& map);

  // By keyframe id: the median over its points of the depth now over the depth before; for an
  // erased keyframe that of the one which stands for it. 1 where nothing is known.
  std::vector<double> ChangesIn(const Map& map) const;

 private:
  struct Depth {
    MapPointId point;
    double depth;
  };
  std::vector<std::vector<Depth>> depths_;  // by keyframe id
};

}  // namespace lift_slam
