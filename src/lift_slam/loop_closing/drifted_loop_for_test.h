#pragma once

#include <cmath>
#include <vector>

#include "lift_slam/loop_closing/loop_corrector.h"
#include "lift_slam/loop_closing/spanning_tree.h"
#include "lift_slam/optimization/pose_graph.h"
#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {

// A camera that goes once around a circle, seeing a window of points that moves on with it; the
// last keyframes see the points of the first again, but have map points of their own for them.
// Scale and heading drift from keyframe to keyframe.
struct DriftedLoop {
  static constexpr int kKeyframes = 120;  // and kWindow more after the whole turn
  static constexpr int kWindow = 5;       // groups of points that a keyframe sees
  static constexpr int kGroup = 16;       // points

  double log_scale_drift = 0.004, yaw_drift_rad = 0.0005;  // per keyframe
  SyntheticFrames scene{kKeyframes * kGroup, 5.0, 10.0, 7};
  Map map{scene.view()};
  SpanningTree tree;
  std::vector<Rigid3d> true_poses;  // by keyframe id
  std::vector<int> true_points;     // by map point id: index into scene.points()
  LoopEdge loop;
  PlaceMatch match;

  DriftedLoop() {
    const int count = kKeyframes + kWindow;
    for (int i = 0; i < count; ++i) {
      true_poses.push_back(TruePose(i));
      Frame frame = scene.MakeFrame(i, true_poses.back());
      frame.cam_from_world = CorrectedPose(Drifted(i));
      map.AddKeyFrame(frame);
    }
    for (int group = 0; group < count + kWindow - 1; ++group) AddGroup(group, count);
    for (const KeyFrameId id : map.KeyFrameIds()) tree.Add(id, map);
    MakeMatch(count - 1);
  }

  static Rigid3d TruePose(int i) {
    const double angle = 2.0 * M_PI * i / kKeyframes;
    return {Eigen::Quaterniond::Identity(),
            -Eigen::Vector3d(std::cos(angle) - 1.0, std::sin(angle), 0.0)};
  }
  // Camera i with its own units, from the true world.
  Sim3d Drift(int keyframe) const {
    const int i = std::max(0, keyframe - kWindow + 1);
    return {std::exp(log_scale_drift * i),
            Eigen::Quaterniond(Eigen::AngleAxisd(yaw_drift_rad * i, Eigen::Vector3d::UnitY())),
            Eigen::Vector3d(0.002 * i, 0.0, 0.001 * i)};
  }
  // The drifted world is the true one moved by Drift, as camera i has it.
  Sim3d Drifted(int i) const {
    const Rigid3d& pose = true_poses[static_cast<std::size_t>(i)];
    return Sim3d(1.0, pose.rotation, pose.translation) * Inverse(Drift(i));
  }

  void AddGroup(int group, int count) {
    const int first = std::max(0, group - kWindow + 1), last = std::min(group, count - 1);
    if (last - first < 1) return;
    for (int k = 0; k < kGroup; ++k) {
      const int index = (group % kKeyframes) * kGroup + k;
      const auto& point = scene.points()[static_cast<std::size_t>(index)];
      const MapPointId id = map.AddPoint(Drift(first) * point, KeyFrameId(last));
      true_points.push_back(index);
      for (int i = first; i <= last; ++i) map.AddObservation(id, KeyFrameId(i), index);
      map.UpdateAppearance(id);
    }
  }

  // The last keyframe recognises the one of the same place in the first turn.
  void MakeMatch(int query) {
    const int candidate = query - kKeyframes;
    loop = {KeyFrameId(query), KeyFrameId(candidate)};
    const double query_scale = Drift(query).scale;
    const Rigid3d pose = true_poses[static_cast<std::size_t>(query)];
    match.query_from_candidate_world =
        Sim3d(query_scale, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()) *
        Sim3d(1.0, pose.rotation, pose.translation) * Inverse(Drift(candidate));
    match.points.resize(scene.points().size());
    for (const MapPointId id : map.PointsSeenBy({loop.candidate})) {
      match.points[static_cast<std::size_t>(true_points[id.index()])] = id;
    }
  }

  // Largest distance of a camera from where it truly is; the truth's frame is that of keyframe 0.
  double LargestPoseError() const {
    double error = 0.0;
    for (const KeyFrameId id : map.KeyFrameIds()) {
      const Eigen::Vector3d truth = true_poses[id.index()].TargetOriginInSource();
      error = std::max(error, (map.keyframe(id).Center() - truth).norm());
    }
    return error;
  }
  double LargestPointError() const {
    double error = 0.0;
    for (const MapPointId id : map.PointIds()) {
      const auto index = static_cast<std::size_t>(true_points[id.index()]);
      error = std::max(error, (map.point(id).position - scene.points()[index]).norm());
    }
    return error;
  }
};

}  // namespace lift_slam
