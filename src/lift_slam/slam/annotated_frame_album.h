#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// Keeps some frames of a run of unknown length with their features: the first one of a map, the
// first ones lost, and others evenly spaced, at most `capacity` of each kind.
class AnnotatedFrameAlbum {
 public:
  void Offer(const PreparedFrame& prepared, const FrameRecord& record,
             const std::vector<int>& tracked_features);
  // All kept frames, by frame index.
  std::vector<AnnotatedFrame> Take();

 private:
  std::vector<AnnotatedFrame> spaced_, special_;
  std::int64_t offered_ = 0, stride_ = 1;
  TrackingState previous_state_ = TrackingState::kInitializing;
};

}  // namespace lift_slam
