#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/local_mapping/culling.h"
#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/map/map.h"
#include "lift_slam/optimization/map_bundle.h"

namespace lift_slam {

struct MappingReport {
  int points_created = 0;
  CulledPoints points_culled;
  int points_fused = 0;
  int keyframes_culled = 0;
  MapBundleReport bundle;
  double create_ms = 0.0, fuse_ms = 0.0, bundle_ms = 0.0, cull_ms = 0.0;
};

// Keyframe to map (paper sec. 3.2 "Mapping"; ORB-SLAM sec. VI): cull recent points, create new
// ones, fuse duplicates, local bundle adjustment, cull redundant keyframes.
class LocalMapper {
 public:
  LocalMapper(const LocalMapperOptions& options, const BundleOptions& bundle)
      : options_(options), bundle_options_(bundle) {}

  // Call once for each new keyframe, before tracking goes on. Descriptors match up to
  // `max_distance`: the strict one of the thresholds.
  MappingReport Process(KeyFrameId keyframe, float max_distance, Map& map);
  // The other mapper's map has been absorbed (Map::Absorb), with ids of points moved up by
  // `offset`.
  void Absorb(const LocalMapper& other, int offset);

 private:
  MapBundleReport AdjustLocalBundle(KeyFrameId keyframe, Map& map) const;

  LocalMapperOptions options_;
  BundleOptions bundle_options_;
  std::vector<RecentPoint> recent_points_;
  int num_mapped_ = 0;
};

}  // namespace lift_slam
