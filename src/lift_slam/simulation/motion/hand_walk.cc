#include "lift_slam/simulation/motion/hand_walk.h"

#include <cmath>
#include <numbers>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr std::string_view kGazeNames[] = {"ahead", "center", "outward"};
constexpr double kWanderRms = 0.7;
constexpr double kPitchShare = 0.3;  // a gaze wanders less up and down than to the sides

enum SeedStream : std::uint64_t { kStart = 200, kYaw, kPitch };

// Ramanujan's approximation, good to 1e-4 for every shape that has a middle.
double EllipseLength(const Eigen::Vector2d& radii) {
  const double a = radii.x(), b = radii.y();
  return std::numbers::pi * (3.0 * (a + b) - std::sqrt((3.0 * a + b) * (a + 3.0 * b)));
}

// World from a camera that looks along a level direction (radians from x towards y).
Eigen::Quaterniond LevelLook(double yaw) {
  const Eigen::Vector3d forward(std::cos(yaw), std::sin(yaw), 0.0);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << down.cross(forward), down, forward;
  return Eigen::Quaterniond(axes);
}

}  // namespace

void WalkOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("laps", laps, "rounds; may be a fraction");
  visitor.Field("speed_m_s", speed_m_s, "on average");
  visitor.Field("height_m", height_m, "of the camera above the scene's lowest point");
  visitor.Field("reach", reach, "size of the ellipse as a share of the scene");
  visitor.Field("bobbing_m", bobbing_m, "up and down with each step");
  visitor.Field("step_frequency_hz", step_frequency_hz, "steps a second");
  visitor.Field("gaze", gaze, kGazeNames, "where the camera looks");
  visitor.Field("look_around_deg", look_around_deg, "most that the gaze wanders to a side");
  visitor.Field("look_period_s", look_period_s, "typical time of one swing");
}

void WalkOptions::Check() const {
  CheckOptionRange("walk.laps", laps, 1e-3, 100.0);
  CheckOptionRange("walk.speed_m_s", speed_m_s, 1e-3, 100.0);
  CheckOptionRange("walk.height_m", height_m, 0.0, 1e4);
  CheckOptionRange("walk.reach", reach, 0.01, 1.0);
  CheckOptionRange("walk.bobbing_m", bobbing_m, 0.0, 1.0);
  CheckOptionRange("walk.step_frequency_hz", step_frequency_hz, 0.01, 20.0);
  CheckOptionRange("walk.look_around_deg", look_around_deg, 0.0, 180.0);
  CheckOptionRange("walk.look_period_s", look_period_s, 0.1, 1e4);
}

HandWalk::HandWalk(const Eigen::AlignedBox3d& box, const WalkOptions& options, std::uint64_t seed)
    : box_(box), options_(options) {
  options.Check();
  const Eigen::Vector3d size = box.sizes();
  if (!(size.x() > 0.0 && size.y() > 0.0) || !size.allFinite()) {
    throw InputError("the scene has no extent to walk in");
  }
  center_ = box.center().head<2>();
  radii_ = 0.5 * options.reach * size.head<2>();
  duration_s_ = options.laps * EllipseLength(radii_) / options.speed_m_s;
  const NoiseBand band = {0.6 / options.look_period_s, 1.6 / options.look_period_s, 0.0};
  yaw_ = BandNoise(MixSeeds(seed, kYaw), band, kWanderRms);
  pitch_ = BandNoise(MixSeeds(seed, kPitch), band, kWanderRms);
  start_phase_ = kTwoPi * static_cast<double>(MixSeeds(seed, kStart) >> 11) * 0x1.0p-53;
}

double HandWalk::GazeYaw(double phase) const {
  const Eigen::Vector2d outward(radii_.x() * std::cos(phase), radii_.y() * std::sin(phase));
  const Eigen::Vector2d ahead(-radii_.x() * std::sin(phase), radii_.y() * std::cos(phase));
  const Eigen::Vector2d look = options_.gaze == WalkGaze::kAhead     ? ahead
                               : options_.gaze == WalkGaze::kOutward ? outward
                                                                     : Eigen::Vector2d(-outward);
  return std::atan2(look.y(), look.x());
}

Rigid3d HandWalk::WorldFromCam(double time_s) const {
  const double time = std::clamp(time_s, 0.0, duration_s_);
  const double phase = start_phase_ + kTwoPi * options_.laps * time / duration_s_;
  const double bob = options_.bobbing_m * std::sin(kTwoPi * options_.step_frequency_hz * time);
  const Eigen::Vector3d position(center_.x() + radii_.x() * std::cos(phase),
                                 center_.y() + radii_.y() * std::sin(phase),
                                 box_.min().z() + options_.height_m + bob);
  const double swing = options_.look_around_deg * kRadians;
  const double pitch = kPitchShare * swing * std::tanh(pitch_.Value(time));
  const Eigen::Quaterniond look = LevelLook(GazeYaw(phase) + swing * std::tanh(yaw_.Value(time)));
  return {look * Eigen::Quaterniond(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX())), position};
}

}  // namespace lift_slam
