#include "lift_slam/visualization/report_scene.h"

#include <algorithm>
#include <limits>
#include <map>

namespace lift_slam {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

void AddPosition(double time_s, const Eigen::Vector3d& x, ScenePath& path) {
  path.time_s.push_back(time_s);
  path.right.push_back(x.x());
  path.up.push_back(x.y());
  path.height.push_back(x.z());
}

// Which map each frame of the input belongs to.
std::map<std::int64_t, int> MapOfFrame(const RunRecord& run) {
  std::map<std::int64_t, int> map_of_frame;
  for (const FrameRecord& frame : run.frames) map_of_frame[frame.frame_index] = frame.map_index;
  return map_of_frame;
}

// Truth that counts frames (KITTI) has no times of its own: those of the run's frames.
Trajectory WithFrameTimes(const RunRecord& run, const Trajectory& truth) {
  std::map<std::int64_t, std::int64_t> time_of_frame;
  for (const FrameRecord& frame : run.frames) time_of_frame[frame.frame_index] = frame.timestamp_ns;
  Trajectory timed;
  for (TrajectoryPose pose : truth) {
    const auto found = time_of_frame.find(pose.frame_index);
    if (found == time_of_frame.end()) continue;
    pose.timestamp_ns = found->second;
    timed.push_back(pose);
  }
  return timed;
}

// The poses of the run's frames or within its times; all when the two do not share a clock.
Trajectory WithinRun(const RunRecord& run, const Trajectory& truth) {
  if (run.frames.empty() || truth.empty()) return truth;
  if (truth.front().frame_index >= 0) return WithFrameTimes(run, truth);
  const std::int64_t first = run.frames.front().timestamp_ns - kSecond / 2;
  const std::int64_t last = run.frames.back().timestamp_ns + kSecond / 2;
  Trajectory inside;
  std::copy_if(truth.begin(), truth.end(), std::back_inserter(inside),
               [&](const TrajectoryPose& pose) {
                 return pose.timestamp_ns >= first && pose.timestamp_ns <= last;
               });
  return inside.size() < 2 ? truth : inside;
}

}  // namespace

void ScenePath::AddGap() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  AddPosition(time_s.empty() ? 0.0 : time_s.back(), {nan, nan, nan}, *this);
}

ReportScene::ReportScene(const RunRecord& run, const ReportData& data)
    : aligned_(data.truth_from_map.has_value()),
      view_(aligned_ ? data.ground_truth_view : TopView::kXZ),
      unit_(aligned_ ? "m" : "map units"),
      shown_from_map_(data.truth_from_map.value_or(Sim3d())) {
  if (!run.frames.empty()) {
    start_ns_ = run.frames.front().timestamp_ns;
    duration_s_ = Seconds(run.frames.back().timestamp_ns);
  }
  AddPaths(run);
  if (aligned_) AddTruth(run, data.ground_truth);
}

std::string ReportScene::RightLabel() const { return "x [" + unit_ + "]"; }

std::string ReportScene::UpLabel() const {
  return (view_ == TopView::kXZ ? "z [" : "y [") + unit_ + "]";
}

std::string ReportScene::HeightLabel() const {
  return (view_ == TopView::kXZ ? "height \xE2\x88\x92y [" : "height z [") + unit_ + "]";
}

double ReportScene::Seconds(std::int64_t timestamp_ns) const {
  return static_cast<double>(timestamp_ns - start_ns_) * 1e-9;
}

Eigen::Vector3d ReportScene::Turn(const Eigen::Vector3d& x) const {
  return view_ == TopView::kXZ ? Eigen::Vector3d(x.x(), x.z(), -x.y()) : x;
}

Eigen::Vector3d ReportScene::OnPage(const Eigen::Vector3d& x_in_map) const {
  return Turn(shown_from_map_ * x_in_map);
}

Eigen::Vector3d ReportScene::DirectionOnPage(const Eigen::Vector3d& direction_in_map) const {
  return Turn(shown_from_map_.rotation * direction_in_map);
}

bool ReportScene::Shows(const ScenePath& path, int map_index) const {
  return aligned_ || path.map_index == map_index;
}

void ReportScene::AddPaths(const RunRecord& run) {
  const std::map<std::int64_t, int> map_of_frame = MapOfFrame(run);
  std::map<int, ScenePath> by_map;
  int previous_map = -1;
  for (const TrajectoryPose& pose : run.final_trajectory) {
    const auto found = map_of_frame.find(pose.frame_index);
    const int map_index = found == map_of_frame.end() ? -1 : found->second;
    const bool shown = pose.state == PoseState::kOk;
    const int now = shown ? map_index : -2;
    if (now != previous_map) {
      for (auto& [unused, path] : by_map) path.AddGap();
    }
    previous_map = now;
    if (!shown) continue;
    ScenePath& path = by_map[aligned_ ? -1 : map_index];
    path.map_index = aligned_ ? -1 : map_index;
    AddPosition(Seconds(pose.timestamp_ns), OnPage(pose.world_from_cam.translation), path);
  }
  for (auto& [unused, path] : by_map) paths_.push_back(std::move(path));
}

void ReportScene::AddTruth(const RunRecord& run, const Trajectory& ground_truth) {
  for (const TrajectoryPose& pose : WithinRun(run, ground_truth)) {
    if (pose.state != PoseState::kOk) continue;
    AddPosition(Seconds(pose.timestamp_ns), Turn(pose.world_from_cam.translation), truth_);
  }
}

}  // namespace lift_slam
