#include "apps/frame_table.h"

#include <fmt/format.h>

#include <iterator>

namespace lift_slam {

std::string FrameTableCsv(const RunRecord& run) {
  std::string csv =
      "frame,timestamp_ns,state,refusal,map,keyframe,features,matches,inliers,low_threshold,"
      "high_threshold,last_matches,last_outliers,extract_ms,track_ms,map_ms\n";
  for (const FrameRecord& f : run.frames) {
    fmt::format_to(std::back_inserter(csv),
                   "{},{},{},{},{},{},{},{},{},{:.4g},{:.4g},{},{},{:.3f},{:.3f},{:.3f}\n",
                   f.frame_index, f.timestamp_ns, Name(f.state), Name(f.refusal), f.map_index,
                   f.is_keyframe ? 1 : 0, f.num_features, f.num_matches, f.num_inliers,
                   f.low_threshold, f.high_threshold, f.num_last_matches, f.num_last_outliers,
                   f.extract_ms, f.track_ms, f.map_ms);
  }
  return csv;
}

}  // namespace lift_slam
