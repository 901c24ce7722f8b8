#pragma once

#include <cstddef>
#include <vector>

#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// An estimated pose and the reference pose of the same moment, both world_from_cam.
struct PosePair {
  std::size_t estimate_index = 0;   // into the estimate; when interpolated, the nearest entry
  std::size_t reference_index = 0;  // into the reference; when interpolated, the nearest entry
  Rigid3d estimate;
  Rigid3d reference;
};

struct Association {
  AssociationMethod method = AssociationMethod::kTime;  // as used, never kAuto
  std::vector<PosePair> pairs;                          // sorted by time or index, one to one
  std::size_t num_unpaired_estimate = 0;                // kOk poses without a partner
  std::size_t num_unpaired_reference = 0;
  double median_time_difference_s = 0.0;  // absolute; 0 for pairs by index
  double max_time_difference_s = 0.0;
};

// kAuto resolved for these trajectories.
AssociationMethod ResolveMethod(const Trajectory& estimate, const Trajectory& reference,
                                AssociationMethod method);

// Pairs the kOk poses of both trajectories, each pose at most once. By time: all candidate pairs
// within the limit, closest first, accepted while both are free. A frame that is missing in one
// trajectory has no pair; nothing is ever shifted.
// No kOk pose in the estimate gives no pairs. Otherwise zero pairs throw an InputError that states
// both ranges and suspects the unit when they are more than a factor 1e6 apart.
Association Associate(const Trajectory& estimate, const Trajectory& reference,
                      const AssociationOptions& options);

}  // namespace lift_slam
