#include "lift_slam/simulation/motion/road_drive.h"

#include <cmath>
#include <numbers>

namespace lift_slam {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
// Root mean square of what tanh() bends to (-1, 1): it is near the limits now and then.
constexpr double kWanderRms = 0.7;

enum SeedStream : std::uint64_t { kLateral, kHeading, kBumpHeight, kBumpPitch, kBumpRoll };

RoadPath MakePath(const Road& road, const DriveOptions& options) {
  options.Check();
  return {options.reverse ? Reversed(road) : road, options.road_smoothing_m};
}

// Swings of about a wavelength, of equal strength.
NoiseBand WanderBand(double wavelength_m) { return {0.6 / wavelength_m, 1.6 / wavelength_m, 0.0}; }

Eigen::Quaterniond Turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace

RoadDrive::RoadDrive(const Road& road, const DriveOptions& options, std::uint64_t seed)
    : options_(options),
      path_(MakePath(road, options)),
      length_m_(options.laps * path_.LengthM() + options.extra_m),
      speed_([this](double distance) { return path_.At(distance).curvature_per_m; },
             path_.LengthM(), options.speed),
      distance_(speed_, options.start_m, length_m_),
      lateral_limit_m_(std::clamp(path_.MinHalfWidthM() - options.edge_margin_m, 0.0,
                                  options.lateral_amplitude_m)),
      lateral_(MixSeeds(seed, kLateral), WanderBand(options.lateral_wavelength_m), kWanderRms),
      heading_(MixSeeds(seed, kHeading), WanderBand(options.heading_wavelength_m), kWanderRms) {
  const NoiseBand springs = {0.6 * options.bump_frequency_hz, 1.6 * options.bump_frequency_hz, 0.5};
  bump_height_ = BandNoise(MixSeeds(seed, kBumpHeight), springs, options.bump_height_m);
  bump_pitch_ = BandNoise(MixSeeds(seed, kBumpPitch), springs, options.bump_pitch_deg * kRadians);
  bump_roll_ = BandNoise(MixSeeds(seed, kBumpRoll), springs, options.bump_roll_deg * kRadians);
}

double RoadDrive::LateralOffsetM(double distance_m) const {
  return lateral_limit_m_ * std::tanh(lateral_.Value(distance_m));
}

Rigid3d RoadDrive::WorldFromBody(double distance_m) const {
  const RoadPlace place = path_.At(options_.start_m + distance_m);
  const double offset = LateralOffsetM(distance_m);
  const double bend = std::tanh(lateral_.Value(distance_m));
  const double drift = lateral_limit_m_ * (1.0 - bend * bend) * lateral_.Derivative(distance_m);
  // Direction of the way that strays by `offset`, beside the road's own, to the left.
  const double along_way = std::atan2(drift, 1.0 - offset * place.curvature_per_m);
  const double looking =
      options_.heading_amplitude_deg * kRadians * std::tanh(heading_.Value(distance_m));
  Eigen::Matrix3d road_axes;
  road_axes << -place.left, -place.up, place.forward;
  // Turning to the left is a negative turn about y, which points down.
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(road_axes) * Turn(-(along_way + looking), Eigen::Vector3d::UnitY());
  return {rotation, place.center + offset * place.left + options_.height_m * place.up};
}

Rigid3d RoadDrive::WorldFromCam(double time_s) const {
  const double time = std::clamp(time_s, 0.0, DurationS());
  const double distance = distance_.DistanceM(time);
  const double liveliness = std::min(1.0, distance_.SpeedM_s(time) / options_.speed.top_m_s);
  const double down = options_.pitch_down_deg * kRadians + liveliness * bump_pitch_.Value(time);
  const Eigen::Quaterniond tilt =
      Turn(liveliness * bump_roll_.Value(time), Eigen::Vector3d::UnitZ()) *
      Turn(-down, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d sway(0.0, -liveliness * bump_height_.Value(time), 0.0);
  return WorldFromBody(distance) * Rigid3d(tilt, sway);
}

}  // namespace lift_slam
