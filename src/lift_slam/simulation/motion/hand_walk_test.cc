#include "lift_slam/simulation/motion/hand_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

Eigen::AlignedBox3d Room() { return {Eigen::Vector3d(1, 2, -1), Eigen::Vector3d(9, 8, 2)}; }

TEST(HandWalk, StaysInTheRoomAtEyeLevel) {
  const HandWalk walk(Room(), {}, 1);
  for (double t = 0.0; t <= walk.DurationS(); t += 0.2) {
    const Eigen::Vector3d position = walk.WorldFromCam(t).translation;
    EXPECT_TRUE(Room().contains(position));
    EXPECT_NEAR(position.z(), 0.6, 0.0151);
  }
}

TEST(HandWalk, EndsWhereItBegan) {
  const HandWalk walk(Room(), {}, 2);
  const Eigen::Vector3d gap =
      walk.WorldFromCam(0.0).translation - walk.WorldFromCam(walk.DurationS()).translation;
  EXPECT_LT(gap.head<2>().norm(), 1e-6);
}

TEST(HandWalk, WalksAtItsSpeedOnAverage) {
  const HandWalk walk(Room(), {}, 3);
  double way = 0.0;
  const double step = walk.DurationS() / 1000;
  for (int i = 0; i < 1000; ++i) {
    way += (walk.WorldFromCam((i + 1) * step).translation - walk.WorldFromCam(i * step).translation)
               .head<2>()
               .norm();
  }
  EXPECT_NEAR(way / walk.DurationS(), 1.0, 0.01);
}

TEST(HandWalk, LooksWhereItIsTold) {
  for (const WalkGaze gaze : {WalkGaze::kAhead, WalkGaze::kCenter, WalkGaze::kOutward}) {
    WalkOptions options;
    options.gaze = gaze;
    options.look_around_deg = 0.0;
    const HandWalk walk(Room(), options, 4);
    const Rigid3d pose = walk.WorldFromCam(3.0);
    const Eigen::Vector3d look = pose.rotation * Eigen::Vector3d::UnitZ();
    Eigen::Vector3d to_center = Room().center() - pose.translation;
    to_center.z() = 0.0;
    const double towards = look.dot(to_center.normalized());
    const double expected = gaze == WalkGaze::kAhead ? 0.0 : gaze == WalkGaze::kCenter ? 1.0 : -1.0;
    EXPECT_NEAR(towards, expected, 0.35) << static_cast<int>(gaze);
    EXPECT_NEAR((pose.rotation * Eigen::Vector3d::UnitY()).z(), -1.0, 1e-9);
  }
}

TEST(HandWalk, RefusesAnEmptyRoomAndOptionsOutOfRange) {
  EXPECT_THROW(HandWalk(Eigen::AlignedBox3d(), {}, 1), InputError);
  WalkOptions options;
  options.speed_m_s = 0.0;
  EXPECT_THROW(HandWalk(Room(), options, 1), InputError);
}

}  // namespace
}  // namespace lift_slam
