#include "lift_slam/testing/camera_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lift_slam {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kStreetSpeed = 8.0;     // metres a second
constexpr double kStreetStep = 0.25;     // metres between the samples of the integrated line
constexpr double kStreetPeriod = 160.0;  // metres from one left curve to the next
constexpr double kStreetSwing = 0.6;     // radians to either side

// Yaw about the y axis (down): positive turns right; pitch positive looks up; then roll.
Eigen::Quaterniond FromAngles(double yaw, double pitch, double roll) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
}

double StreetHeading(double distance) {
  return kStreetSwing * std::sin(kTwoPi * distance / kStreetPeriod);
}

// Position after every kStreetStep metres (midpoint rule).
std::vector<Eigen::Vector3d> IntegrateStreet() {
  std::vector<Eigen::Vector3d> line{Eigen::Vector3d::Zero()};
  const int steps = static_cast<int>(kStreetLength / kStreetStep) + 2;
  for (int i = 0; i < steps; ++i) {
    const double heading = StreetHeading((i + 0.5) * kStreetStep);
    line.push_back(line.back() +
                   kStreetStep * Eigen::Vector3d(std::sin(heading), 0.0, std::cos(heading)));
  }
  return line;
}

Rigid3d OnStreetDrive(double t) {
  const Eigen::Quaterniond bumps =
      FromAngles(0.0, 0.004 * std::sin(3.1 * t), 0.003 * std::sin(2.3 * t));
  const Rigid3d street_from_cam(bumps, {0.0, 0.015 * std::sin(4.0 * t), 0.0});
  return WorldFromStreet(kStreetSpeed * t) * street_from_cam;
}

Rigid3d OnRoomSway(double t) {
  const Eigen::Vector3d position(0.45 * std::sin(0.9 * t), -0.1 + 0.15 * std::sin(1.3 * t + 1.0),
                                 -1.6 + 0.35 * std::sin(0.6 * t + 2.0));
  return {FromAngles(0.25 * std::sin(0.7 * t), 0.1 * std::sin(1.1 * t), 0.06 * std::sin(0.8 * t)),
          position};
}

Rigid3d OnRoomRotation(double t) {
  return {FromAngles(0.7 * std::sin(0.5 * t), 0.1 * std::sin(0.9 * t), 0.0), {0.0, -0.1, -1.6}};
}

Rigid3d OnRoomLoop(double t) {
  const double phase = kTwoPi * t / 20.0;
  const Eigen::Vector3d position(2.6 * std::sin(phase), -0.2 + 0.05 * std::sin(3.0 * phase),
                                 -1.8 * std::cos(phase));
  // The direction of motion, turned a little to the inside of the loop (left).
  const double ahead = std::atan2(2.6 * std::cos(phase), 1.8 * std::sin(phase));
  return {FromAngles(ahead - 0.3, 0.03 * std::sin(2.0 * phase), 0.0), position};
}

}  // namespace

std::string_view Name(SyntheticPath path) {
  switch (path) {
    case SyntheticPath::kStreetDrive:
      return "street_drive";
    case SyntheticPath::kRoomSway:
      return "room_sway";
    case SyntheticPath::kRoomRotation:
      return "room_rotation";
    case SyntheticPath::kRoomStill:
      return "room_still";
    case SyntheticPath::kRoomLoop:
      return "room_loop";
  }
  return "unknown";
}

double PathDurationS(SyntheticPath path) {
  return path == SyntheticPath::kStreetDrive ? kStreetLength / kStreetSpeed
                                             : std::numeric_limits<double>::infinity();
}

Rigid3d WorldFromStreet(double distance) {
  static const std::vector<Eigen::Vector3d> line = IntegrateStreet();
  const double place = std::clamp(distance, 0.0, kStreetLength) / kStreetStep;
  const auto index = static_cast<std::size_t>(place);
  const double weight = place - static_cast<double>(index);
  const Eigen::Vector3d position = (1.0 - weight) * line[index] + weight * line[index + 1];
  return {FromAngles(StreetHeading(place * kStreetStep), 0.0, 0.0), position};
}

Rigid3d WorldFromCamOnPath(SyntheticPath path, double time_s) {
  switch (path) {
    case SyntheticPath::kStreetDrive:
      return OnStreetDrive(time_s);
    case SyntheticPath::kRoomSway:
      return OnRoomSway(time_s);
    case SyntheticPath::kRoomRotation:
      return OnRoomRotation(time_s);
    case SyntheticPath::kRoomStill:
      return OnRoomSway(0.0);
    case SyntheticPath::kRoomLoop:
      return OnRoomLoop(time_s);
  }
  return {};
}

}  // namespace lift_slam
