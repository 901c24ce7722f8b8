#include "lift_slam/simulation/motion/recorded_motion.h"

#include <gtest/gtest.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

TrajectoryPose PoseAt(double time_s, double x, double yaw) {
  TrajectoryPose pose;
  pose.timestamp_ns = static_cast<std::int64_t>(time_s * 1e9);
  pose.world_from_cam = {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY())),
                         {x, 2.0, 3.0}};
  return pose;
}

Trajectory Uneven() {
  return {PoseAt(100.0, 0.0, 0.0), PoseAt(100.5, 1.0, 0.1), PoseAt(102.0, 2.0, 0.4),
          PoseAt(103.0, 7.0, 0.4)};
}

TEST(RecordedMotion, PassesThroughEveryPose) {
  const RecordedMotion motion(Uneven());
  EXPECT_DOUBLE_EQ(motion.DurationS(), 3.0);
  const std::vector<std::int64_t> times = motion.TimesNs();
  ASSERT_EQ(times.size(), 4U);
  EXPECT_EQ(times[2], 2000000000);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Rigid3d pose = motion.WorldFromCam(static_cast<double>(times[i]) * 1e-9);
    EXPECT_LT((pose.translation - Uneven()[i].world_from_cam.translation).norm(), 1e-12);
    EXPECT_LT(pose.rotation.angularDistance(Uneven()[i].world_from_cam.rotation), 1e-7);
  }
}

TEST(RecordedMotion, VelocityDoesNotJump) {
  const RecordedMotion motion(Uneven());
  for (const double knot : {0.5, 2.0}) {
    const double x = motion.WorldFromCam(knot).translation.x();
    const double before = (x - motion.WorldFromCam(knot - 1e-6).translation.x()) / 1e-6;
    const double after = (motion.WorldFromCam(knot + 1e-6).translation.x() - x) / 1e-6;
    EXPECT_NEAR(before, after, 1e-3);
  }
}

TEST(RecordedMotion, StandsStillOutsideItsTime) {
  const RecordedMotion motion(Uneven());
  EXPECT_EQ(motion.WorldFromCam(-1.0).translation.x(), 0.0);
  EXPECT_EQ(motion.WorldFromCam(9.0).translation.x(), 7.0);
}

TEST(RecordedMotion, LeavesOutLostPosesAndRefusesNone) {
  Trajectory poses = Uneven();
  poses[0].state = PoseState::kLost;
  EXPECT_DOUBLE_EQ(RecordedMotion(poses).DurationS(), 2.5);
  EXPECT_THROW(RecordedMotion{Trajectory()}, InputError);
}

TEST(MovedToStart, KeepsRelativePosesAndScales) {
  const Rigid3d start(Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX())),
                      {10.0, 20.0, 30.0});
  const Trajectory moved = MovedToStart(Uneven(), start, 2.0);
  EXPECT_LT((moved[0].world_from_cam.translation - start.translation).norm(), 1e-12);
  const Rigid3d before = Inverse(Uneven()[1].world_from_cam) * Uneven()[3].world_from_cam;
  const Rigid3d after = Inverse(moved[1].world_from_cam) * moved[3].world_from_cam;
  EXPECT_LT((after.translation - 2.0 * before.translation).norm(), 1e-9);
  EXPECT_LT(after.rotation.angularDistance(before.rotation), 1e-7);
}

}  // namespace
}  // namespace lift_slam
