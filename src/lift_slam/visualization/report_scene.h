#pragma once

#include <string>
#include <vector>

#include "lift_slam/slam/run_record.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// A path as it is shown, one entry a frame: seconds since the first frame of the run, and the
// position on the page: right, up (of the top view) and height. NaN where there is no pose.
struct ScenePath {
  int map_index = -1;  // -1: all maps in one frame, or ground truth
  std::vector<double> time_s, right, up, height;

  void AddGap();
  bool empty() const { return right.empty(); }
};

// The run in the coordinates of the report: the ground truth's frame in metres when it is aligned,
// else each map in its own frame and unit.
class ReportScene {
 public:
  ReportScene(const RunRecord& run, const ReportData& data);

  bool aligned() const { return aligned_; }
  TopView view() const { return view_; }
  const std::string& unit() const { return unit_; }  // "m" or "map units"
  // Names of the axes with the unit: "x [m]", "z [m]", "height [m]".
  std::string RightLabel() const;
  std::string UpLabel() const;
  std::string HeightLabel() const;

  // One path for each map that has poses; a single one when aligned.
  const std::vector<ScenePath>& paths() const { return paths_; }
  // The part of the ground truth within the run's time; empty without alignment.
  const ScenePath& truth() const { return truth_; }
  double Seconds(std::int64_t timestamp_ns) const;
  double duration_s() const { return duration_s_; }  // first to last frame
  // A point or camera centre of the run as (right, up, height), right-handed.
  Eigen::Vector3d OnPage(const Eigen::Vector3d& x_in_map) const;
  // A direction of the run's frame on the page, without scale.
  Eigen::Vector3d DirectionOnPage(const Eigen::Vector3d& direction_in_map) const;
  // Whether something of this map belongs to the path: always when aligned.
  bool Shows(const ScenePath& path, int map_index) const;

 private:
  Eigen::Vector3d Turn(const Eigen::Vector3d& x) const;
  void AddPaths(const RunRecord& run);
  void AddTruth(const RunRecord& run, const Trajectory& ground_truth);

  bool aligned_;
  TopView view_;
  std::string unit_;
  Sim3d shown_from_map_;
  std::int64_t start_ns_ = 0;
  double duration_s_ = 0.0;
  std::vector<ScenePath> paths_;
  ScenePath truth_;
};

}  // namespace lift_slam
