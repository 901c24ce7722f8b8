#pragma once

#include <string>

#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// One line a frame with all its numbers, as CSV with a header: frame, timestamp_ns, state, refusal,
// map, keyframe (0 or 1), features, matches, inliers, low_threshold and high_threshold (distances
// of descriptors), last_matches, last_outliers (adaptive thresholds, paper Fig. 5), extract_ms,
// track_ms, map_ms. map is -1 for a frame without a final pose.
std::string FrameTableCsv(const RunRecord& run);

}  // namespace lift_slam
