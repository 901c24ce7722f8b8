#pragma once

#include <iosfwd>

#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// The maps as binary little-endian PLY vertices: x y z (float, map units, each map in its own
// frame), red green blue (uchar), map (int, index). First the points in the grey level they were
// seen in, then one orange vertex for each keyframe's camera centre.
void WriteMapPly(const RunRecord& run, std::ostream& stream);

}  // namespace lift_slam
