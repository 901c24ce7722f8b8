#include "lift_slam/simulation/motion/road_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/motion/test_roads.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

DriveOptions OneLapAndMore() {
  DriveOptions options;
  options.extra_m = 100.0;
  return options;
}

// No wander, no bumps: the camera rides on the centre line.
DriveOptions OnRails() {
  DriveOptions options;
  options.lateral_amplitude_m = options.heading_amplitude_deg = 0.0;
  options.bump_height_m = options.bump_pitch_deg = options.bump_roll_deg = 0.0;
  return options;
}

Eigen::Vector3d Forward(const Rigid3d& world_from_cam) {
  return world_from_cam.rotation * Eigen::Vector3d::UnitZ();
}

TEST(RoadDrive, DrivesItsLapsAndTheRest) {
  const RoadDrive drive(OvalRoad(), OneLapAndMore(), 1);
  EXPECT_NEAR(drive.LengthM(), drive.path().LengthM() + 100.0, 1e-9);
  EXPECT_NEAR(drive.DistanceM(drive.DurationS()), drive.LengthM(), 1e-6);
}

TEST(RoadDrive, LooksAlongTheRoadAboveIt) {
  const RoadDrive drive(OvalRoad(), OnRails(), 1);
  for (double t = 0.0; t < drive.DurationS(); t += 1.7) {
    const Rigid3d pose = drive.WorldFromCam(t);
    const RoadPlace place = drive.path().At(drive.DistanceM(t));
    EXPECT_LT((Forward(pose) - place.forward).norm(), 1e-6);
    EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY() + place.up).norm(), 1e-6);
    EXPECT_LT((pose.translation - place.center - 1.65 * place.up).norm(), 1e-6);
  }
}

TEST(RoadDrive, PitchDownLooksAtTheRoad) {
  DriveOptions options = OnRails();
  options.pitch_down_deg = 10.0;
  const RoadDrive drive(CircleRoad(60.0, 60), options, 1);
  EXPECT_NEAR(Forward(drive.WorldFromCam(3.0)).z(), -std::sin(10.0 * std::numbers::pi / 180.0),
              1e-3);
}

TEST(RoadDrive, LooksWhereItMovesWhenWandering) {
  DriveOptions options = OnRails();
  options.lateral_amplitude_m = 2.0;
  options.lateral_wavelength_m = 40.0;
  const RoadDrive drive(OvalRoad(), options, 3);
  for (double t = 1.0; t < drive.DurationS() - 1.0; t += 0.9) {
    const Eigen::Vector3d moved =
        drive.WorldFromCam(t + 1e-3).translation - drive.WorldFromCam(t - 1e-3).translation;
    // The rest is the height above a road that turns in space.
    EXPECT_GT(moved.normalized().dot(Forward(drive.WorldFromCam(t))), std::cos(0.03)) << t;
  }
}

// Changes from step to step bound velocity and acceleration, so a jump would show.
TEST(RoadDrive, HasNoJumpInPoseOrVelocityAnywhere) {
  const RoadDrive drive(OvalRoad(), OneLapAndMore(), 5);
  const double step = 0.01;
  double most_acceleration = 0.0, most_turn_change = 0.0;
  for (double t = 2 * step; t < drive.DurationS(); t += step) {
    const Rigid3d a = drive.WorldFromCam(t - 2 * step), b = drive.WorldFromCam(t - step),
                  c = drive.WorldFromCam(t);
    const Eigen::Vector3d acceleration =
        (c.translation - 2.0 * b.translation + a.translation) / (step * step);
    most_acceleration = std::max(most_acceleration, acceleration.norm());
    const Eigen::Quaterniond first = a.rotation.conjugate() * b.rotation;
    const Eigen::Quaterniond second = b.rotation.conjugate() * c.rotation;
    most_turn_change =
        std::max(most_turn_change, RotationAngle(first.conjugate() * second) / (step * step));
  }
  EXPECT_LT(most_acceleration, 6.5);  // m/s^2: curve, brakes, hill and bumps together
  EXPECT_LT(most_turn_change, 3.0);   // rad/s^2
}

TEST(RoadDrive, SecondLapIsBesideTheFirstAndOnTheRoad) {
  DriveOptions options;
  options.laps = 2.0;
  options.lateral_amplitude_m = 1.5;
  const RoadDrive drive(OvalRoad(), options, 7);
  const double lap = drive.path().LengthM();
  double apart = 0.0;
  for (double s = 0.0; s < lap; s += 1.0) {
    EXPECT_LE(std::abs(drive.LateralOffsetM(s)), 1.5);
    apart = std::max(apart, std::abs(drive.LateralOffsetM(s) - drive.LateralOffsetM(s + lap)));
  }
  EXPECT_GT(apart, 0.5);
}

TEST(RoadDrive, WanderIsHeldOnANarrowRoad) {
  DriveOptions options;
  options.lateral_amplitude_m = 50.0;
  const RoadDrive drive(OvalRoad(), options, 7);
  for (double s = 0.0; s < drive.LengthM(); s += 1.0) {
    EXPECT_LT(std::abs(drive.LateralOffsetM(s)), kTestRoadHalfWidthM - 1.0);
  }
}

TEST(RoadDrive, SameSeedSameDrive) {
  const RoadDrive drive(OvalRoad(), OneLapAndMore(), 9), same(OvalRoad(), OneLapAndMore(), 9),
      other(OvalRoad(), OneLapAndMore(), 10);
  EXPECT_EQ(drive.WorldFromCam(12.3).translation, same.WorldFromCam(12.3).translation);
  EXPECT_NE(drive.WorldFromCam(12.3).translation, other.WorldFromCam(12.3).translation);
}

TEST(RoadDrive, ReverseDrivesAgainstTheRoad) {
  DriveOptions options = OnRails();
  options.reverse = true;
  const RoadDrive drive(OvalRoad(), OnRails(), 1), back(OvalRoad(), options, 1);
  EXPECT_LT(Forward(drive.WorldFromCam(0.0)).dot(Forward(back.WorldFromCam(0.0))), -0.99);
}

TEST(RoadDrive, RefusesOptionsOutOfRangeByName) {
  const auto why = [](const DriveOptions& options) -> std::string {
    try {
      RoadDrive(OvalRoad(), options, 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  DriveOptions options;
  options.height_m = -1.0;
  EXPECT_THAT(why(options), HasSubstr("drive.height_m"));
  options = {};
  options.laps = 0.0;
  EXPECT_THAT(why(options), HasSubstr("both 0"));
  options = {};
  options.speed.top_m_s = 0.0;
  EXPECT_THAT(why(options), HasSubstr("drive.speed.top_m_s"));
}

}  // namespace
}  // namespace lift_slam
