#pragma once

#include <vector>

#include "lift_slam/geometry/sim3.h"
#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// A loop is believed when two keyframes say the same of it: from where the first is by its
// similarity, the motion between both, as the map has it, leads to where the second is by its own.
// A skyline or a texture that repeats itself puts every keyframe of a stretch in the same wrong
// place, with points enough; but that place does not move on with the camera. A wrong scale shows
// as well, as the motion is measured in it.
class LoopConfirmation {
 public:
  explicit LoopConfirmation(const LoopConfirmationOptions& options) : options_(options) {}

  // Whether an earlier claim agrees that the query is at this pose in the world of the candidate
  // (coordinates and units of the query's camera). Remembers the claim.
  bool Confirms(KeyFrameId query, const Sim3d& query_from_candidate_world, const Map& map);
  // After a correction, which moves what was claimed.
  void Reset() { claims_.clear(); }

 private:
  struct Claim {
    KeyFrameId query;
    Sim3d query_from_candidate_world;
  };

  bool Agree(const Claim& earlier, const Claim& claim, const Map& map) const;

  LoopConfirmationOptions options_;
  std::vector<Claim> claims_;  // recent ones, by age
};

}  // namespace lift_slam
