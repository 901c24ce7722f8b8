#pragma once

#include "apps/finished_run.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// The words and numbers of a run's report.
ReportData MakeReportData(const FinishedRun& finished);

}  // namespace lift_slam
