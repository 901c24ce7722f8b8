#pragma once

#include <string>

#include "lift_slam/slam/run_record.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// The report of a run as one HTML page that needs nothing else: styles, plots, pictures and the
// script of the map viewer are inside. Works for any run: no ground truth, no map, several maps.
std::string ReportHtml(const RunRecord& run, const ReportData& data);

}  // namespace lift_slam
