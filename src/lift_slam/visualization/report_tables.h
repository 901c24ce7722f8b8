#pragma once

#include <string>
#include <vector>

#include "lift_slam/slam/run_record.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// HTML of the report's tables; empty when there is nothing to show.
std::string KeyNumbersHtml(const std::vector<ReportRow>& rows);
std::string TableHtml(const ReportTable& table);
// Frames by state, and each refusal that happened with its share and explanation.
std::string StatesHtml(const RunRecord& run);
// Refusals that happened, the most frequent first; kNone is none.
std::vector<FrameRefusal> RefusalsByCount(const RunRecord& run);
std::string RefusalsHtml(const RunRecord& run);
// Runs, median, mean, 95th percentile, maximum and total of each stage.
std::string StageTimesHtml(const StageTimes& times_ms);
// Places recognised and refused by geometry, each with its numbers and the reason; above it why
// places were not recognised at all.
std::string PlacesHtml(const RunRecord& run);
// RunRecord::counters, grouped by stage.
std::string CountersHtml(const RunRecord& run);

}  // namespace lift_slam
