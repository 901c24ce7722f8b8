#include "lift_slam/loop_closing/loop_confirmation.h"

#include <algorithm>

namespace lift_slam {

bool LoopConfirmation::Confirms(KeyFrameId query, const Sim3d& query_from_candidate_world,
                                const Map& map) {
  std::erase_if(claims_, [&](const Claim& claim) {
    return query.value - claim.query.value > options_.max_keyframes_between ||
           map.FindKeyFrame(claim.query) == nullptr;
  });
  const Claim claim{query, query_from_candidate_world};
  const bool is_confirmed = !options_.enabled || std::ranges::any_of(claims_, [&](const Claim& c) {
    return Agree(c, claim, map);
  });
  claims_.push_back(claim);
  return is_confirmed;
}

bool LoopConfirmation::Agree(const Claim& earlier, const Claim& claim, const Map& map) const {
  const Rigid3d earlier_from_query = map.keyframe(earlier.query).cam_from_world *
                                     Inverse(map.keyframe(claim.query).cam_from_world);
  const Sim3d world_from_earlier = Inverse(earlier.query_from_candidate_world);
  const Eigen::Vector3d start = world_from_earlier * Eigen::Vector3d::Zero();
  const Eigen::Vector3d expected = world_from_earlier * earlier_from_query.translation;
  const Eigen::Vector3d found = Inverse(claim.query_from_candidate_world) * Eigen::Vector3d::Zero();
  return (found - expected).norm() <= options_.max_disagreement * (expected - start).norm();
}

}  // namespace lift_slam
