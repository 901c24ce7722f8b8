#pragma once

#include <string>

#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// HTML of at most nine annotated frames by time: always the first with a map and the one with the
// fewest tracked points, the others evenly spaced. Empty when the run kept none.
std::string FrameGalleryHtml(const RunRecord& run);

}  // namespace lift_slam
