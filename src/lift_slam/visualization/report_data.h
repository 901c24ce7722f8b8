#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lift_slam/geometry/sim3.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Which two axes of the world the top view shows, right and up on the page, and what "up" is.
enum class TopView {
  kXZ,  // first camera's frame, KITTI: x right, z forward; height is -y
  kXY,  // world with z up: x right, y up on the page; height is z
};

enum class ReportStatus { kOk, kPartial, kFailed };

// One number of the report.
struct ReportRow {
  std::string name, value, unit;
  std::string note;  // what it means, a sentence or less; may be empty
};

struct ReportTable {
  std::string title;
  std::vector<ReportRow> rows;
};

struct ErrorSample {
  std::int64_t timestamp_ns = 0;
  double error_m = 0.0;  // distance to the ground truth after alignment
};

// What the report shows besides the RunRecord itself.
struct ReportData {
  std::string title = "lift_slam run";
  std::string sequence;  // name or path
  ReportStatus status = ReportStatus::kOk;
  std::string status_label;            // "OK", "PARTIAL", "FAIL_INIT", "FAIL_LOST"
  std::string summary;                 // one or two sentences: what happened
  std::string advice;                  // what may help; empty when nothing needs help
  std::vector<ReportRow> key_numbers;  // about eight, shown large at the top
  std::vector<ReportTable> tables;     // all numbers
  Trajectory ground_truth;             // camera poses in metres; may be empty
  TopView ground_truth_view = TopView::kXY;
  // Puts the run into the ground truth's frame, in metres; nothing: the run is shown as it is.
  std::optional<Sim3d> truth_from_map;
  std::vector<ErrorSample> errors;  // by time; of the aligned final trajectory
  double ate_rmse_m = 0.0;          // drawn with the errors
  ReportTable provenance;
  std::string configuration;  // effective, YAML text
};

}  // namespace lift_slam
