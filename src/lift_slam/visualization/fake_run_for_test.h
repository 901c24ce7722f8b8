#pragma once

#include <vector>

#include "lift_slam/slam/run_record.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// A made-up drive through streets with turns: a run as the SLAM system would leave it, for tests
// and for looking at the report. Nothing in it is measured.
struct FakeRunOptions {
  int num_frames = 160;
  int num_maps = 1;  // 0: never initialised; more than 1: lost in between
  int points_per_keyframe = 60;
  int num_annotated = 6;
  double map_units_per_metre = 0.08;
};

struct FakeRun {
  RunRecord run;
  Trajectory truth;  // metres, first-camera frame as in KITTI
  Sim3d truth_from_map;
};

FakeRun MakeFakeRun(const FakeRunOptions& options);

// Everything a report needs for it; `with_truth` adds the alignment and the errors.
ReportData MakeFakeReportData(const FakeRun& fake, bool with_truth);

}  // namespace lift_slam
