#pragma once

#include <string>

#include "lift_slam/visualization/report_scene.h"

namespace lift_slam {

// HTML of a map that can be turned with the mouse: a canvas, its data (at most 30 000 points,
// positions as 16-bit integers) and its script, all inline. Empty when there is no path.
std::string MapViewerHtml(const RunRecord& run, const ReportScene& scene);

}  // namespace lift_slam
