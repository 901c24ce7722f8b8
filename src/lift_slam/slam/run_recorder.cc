#include "lift_slam/slam/run_recorder.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lift_slam {
namespace {

std::optional<Rigid3d> FinalPose(const MapSession& session,
                                 const MapSession::FrameReference& frame) {
  const auto reference = session.map().ResolveReference(frame.reference);
  if (!reference) return std::nullopt;
  const Rigid3d cam_from_world = frame.cam_from_reference * reference->cam_from_keyframe *
                                 session.map().keyframe(reference->keyframe).cam_from_world;
  return Inverse(cam_from_world);
}

// All frames without poses: not initialised until the first map was begun, lost from then on, also
// while a further map is being begun and where a map was thrown away.
Trajectory WithoutPoses(const RunRecord& record) {
  Trajectory trajectory;
  bool was_begun = false;
  for (const FrameRecord& frame : record.frames) {
    was_begun = was_begun || frame.state != TrackingState::kInitializing;
    TrajectoryPose pose;
    pose.frame_index = frame.frame_index;
    pose.timestamp_ns = frame.timestamp_ns;
    pose.state = was_begun ? PoseState::kLost : PoseState::kNotInitialized;
    trajectory.push_back(pose);
  }
  return trajectory;
}

void AddOnlineTrajectory(RunRecord& record) {
  record.online_trajectory = WithoutPoses(record);
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FrameRecord& frame = record.frames[i];
    if (!frame.world_from_cam || frame.map_index < 0) continue;  // lost, or of a map thrown away
    record.online_trajectory[i].world_from_cam = *frame.world_from_cam;
    record.online_trajectory[i].state = PoseState::kOk;
  }
}

void AddFinalTrajectory(const std::vector<std::unique_ptr<MapSession>>& sessions,
                        RunRecord& record) {
  struct PoseInMap {
    Rigid3d world_from_cam;
    int map_index;
  };
  std::map<std::int64_t, PoseInMap> poses;  // by frame index; a later map does not replace a pose
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    for (const auto& frame : sessions[i]->frames()) {
      const auto pose = FinalPose(*sessions[i], frame);
      if (pose) poses.emplace(frame.frame_index, PoseInMap{*pose, static_cast<int>(i)});
    }
  }
  record.final_trajectory = WithoutPoses(record);
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const auto found = poses.find(record.frames[i].frame_index);
    if (found == poses.end()) continue;
    record.frames[i].map_index = found->second.map_index;  // also of frames tracked backwards
    record.final_trajectory[i].world_from_cam = found->second.world_from_cam;
    record.final_trajectory[i].state = PoseState::kOk;
  }
}

void AddKeyFrames(const Map& map, int map_index, std::vector<int>& keyframe_rows,
                  RunRecord& record) {
  for (const KeyFrameId id : map.KeyFrameIds()) {
    const KeyFrame& keyframe = map.keyframe(id);
    keyframe_rows.resize(id.index() + 1, -1);
    keyframe_rows[id.index()] = static_cast<int>(record.keyframes.size());
    KeyFrameRecord row;
    row.pose.frame_index = keyframe.frame_index;
    row.pose.timestamp_ns = keyframe.timestamp_ns;
    row.pose.world_from_cam = Inverse(keyframe.cam_from_world);
    row.map_index = map_index;
    row.is_loaded = keyframe.is_loaded;
    record.keyframes.push_back(row);
  }
}

PointRecord MakePointRecord(const MapSession& session, const MapPoint& point,
                            const std::vector<int>& keyframe_rows) {
  const Map& map = session.map();
  PointRecord row;
  row.position = point.position;
  double error = 0.0;
  for (const auto& observation : point.observations) {
    const KeyFrame& keyframe = map.keyframe(observation.keyframe);
    const Eigen::Vector2d pixel =
        session.correction().ToIdeal(map.view().pinhole, observation.pixel.cast<double>());
    error += (map.view().pinhole.Project(keyframe.cam_from_world * point.position) - pixel).norm();
    row.observations.push_back({keyframe_rows[observation.keyframe.index()],
                                static_cast<float>(pixel.x()), static_cast<float>(pixel.y())});
  }
  row.reprojection_error_px =
      static_cast<float>(error / static_cast<double>(point.observations.size()));
  return row;
}

// The second of two maps may have grown before the first one did.
void SortKeyFramesByTime(RunRecord& record) {
  std::vector<int> order(record.keyframes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto stamp = [&](int row) {
    return record.keyframes[static_cast<std::size_t>(row)].pose.timestamp_ns;
  };
  std::ranges::stable_sort(order, {}, stamp);
  std::vector<KeyFrameRecord> sorted;
  std::vector<int> new_row(order.size());
  for (const int row : order) {
    new_row[static_cast<std::size_t>(row)] = static_cast<int>(sorted.size());
    sorted.push_back(record.keyframes[static_cast<std::size_t>(row)]);
  }
  record.keyframes = std::move(sorted);
  for (PointRecord& point : record.points) {
    for (PointRecord::Observation& observation : point.observations) {
      observation.keyframe = new_row[static_cast<std::size_t>(observation.keyframe)];
    }
  }
}

}  // namespace

void CompleteRunRecord(const std::vector<std::unique_ptr<MapSession>>& sessions,
                       RunRecord& record) {
  AddOnlineTrajectory(record);
  AddFinalTrajectory(sessions, record);
  record.num_maps = static_cast<int>(sessions.size());
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const Map& map = sessions[i]->map();
    const int map_index = static_cast<int>(i);
    record.calibrations.push_back(sessions[i]->calibration());
    std::vector<int> keyframe_rows;  // by keyframe id
    AddKeyFrames(map, map_index, keyframe_rows, record);
    for (const MapPointId id : map.PointIds()) {
      PointRecord row = MakePointRecord(*sessions[i], map.point(id), keyframe_rows);
      row.map_index = map_index;
      row.gray = sessions[i]->GrayOf(id);
      record.points.push_back(std::move(row));
    }
  }
  SortKeyFramesByTime(record);
}

}  // namespace lift_slam
