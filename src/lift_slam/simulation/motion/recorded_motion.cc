#include "lift_slam/simulation/motion/recorded_motion.h"

#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

RecordedMotion::RecordedMotion(const Trajectory& world_from_cam) {
  for (const TrajectoryPose& pose : world_from_cam) {
    if (pose.state != PoseState::kOk) continue;
    const std::int64_t first_ns = poses_.empty() ? pose.timestamp_ns : poses_.front().time_ns;
    poses_.push_back({pose.timestamp_ns, static_cast<double>(pose.timestamp_ns - first_ns) * 1e-9,
                      pose.world_from_cam, Eigen::Vector3d::Zero()});
    LIFT_SLAM_CHECK(poses_.size() == 1 || poses_.back().time_s > poses_[poses_.size() - 2].time_s,
                    "times must increase, at {} ns", pose.timestamp_ns);
  }
  if (poses_.empty()) throw InputError("there is no pose to move along");
  SetVelocities();
}

// Of the parabola through a pose and its neighbours; at the ends of the straight line.
void RecordedMotion::SetVelocities() {
  const auto slope = [this](std::size_t i) -> Eigen::Vector3d {
    return (poses_[i + 1].world_from_cam.translation - poses_[i].world_from_cam.translation) /
           (poses_[i + 1].time_s - poses_[i].time_s);
  };
  const std::size_t size = poses_.size();
  if (size < 2) return;
  poses_.front().velocity = slope(0);
  poses_.back().velocity = slope(size - 2);
  for (std::size_t i = 1; i + 1 < size; ++i) {
    const double before = poses_[i].time_s - poses_[i - 1].time_s;
    const double after = poses_[i + 1].time_s - poses_[i].time_s;
    poses_[i].velocity = (after * slope(i - 1) + before * slope(i)) / (before + after);
  }
}

Rigid3d RecordedMotion::WorldFromCam(double time_s) const {
  const auto next =
      std::upper_bound(poses_.begin(), poses_.end(), time_s,
                       [](double time, const TimedPose& pose) { return time < pose.time_s; });
  if (next == poses_.begin()) return poses_.front().world_from_cam;
  if (next == poses_.end()) return poses_.back().world_from_cam;
  const TimedPose& from = *(next - 1);
  const TimedPose& to = *next;
  const double step = to.time_s - from.time_s;
  const double t = (time_s - from.time_s) / step, s = 1.0 - t;
  const Eigen::Vector3d position =
      (1.0 + 2.0 * t) * s * s * from.world_from_cam.translation + t * s * s * step * from.velocity +
      t * t * (3.0 - 2.0 * t) * to.world_from_cam.translation - t * t * s * step * to.velocity;
  return {from.world_from_cam.rotation.slerp(t, to.world_from_cam.rotation), position};
}

std::vector<std::int64_t> RecordedMotion::TimesNs() const {
  std::vector<std::int64_t> times;
  for (const TimedPose& pose : poses_) times.push_back(pose.time_ns - poses_.front().time_ns);
  return times;
}

Trajectory MovedToStart(const Trajectory& trajectory, const Rigid3d& start, double scale) {
  if (trajectory.empty()) return trajectory;
  const Rigid3d first_from_world = Inverse(trajectory.front().world_from_cam);
  Trajectory moved = trajectory;
  for (TrajectoryPose& pose : moved) {
    Rigid3d first_from_cam = first_from_world * pose.world_from_cam;
    first_from_cam.translation *= scale;
    pose.world_from_cam = start * first_from_cam;
  }
  return moved;
}

}  // namespace lift_slam
