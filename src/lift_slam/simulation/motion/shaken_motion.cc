#include "lift_slam/simulation/motion/shaken_motion.h"

#include <fmt/format.h>

#include <numbers>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::uint64_t kFirstStream = 100;  // apart from those of other motions

Eigen::Vector3d Value(const std::array<BandNoise, 3>& noise, double time_s) {
  return {noise[0].Value(time_s), noise[1].Value(time_s), noise[2].Value(time_s)};
}

}  // namespace

void ShakeOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("translation_m", translation_m, "root mean square along each axis");
  visitor.Field("rotation_deg", rotation_deg, "root mean square about each axis");
  visitor.Field("low_hz", low_hz, "slowest trembling");
  visitor.Field("high_hz", high_hz, "fastest trembling");
}

void ShakeOptions::Check() const {
  if (!(translation_m >= 0.0) || !(rotation_deg >= 0.0) || rotation_deg > 45.0) {
    throw InputError(fmt::format(
        "shake.translation_m is {} and shake.rotation_deg {}, expected 0 or more (at most 45 deg)",
        translation_m, rotation_deg));
  }
  if (!(low_hz > 0.0) || !(high_hz >= low_hz)) {
    throw InputError(
        fmt::format("shake.low_hz is {} and shake.high_hz {}, expected 0 < low_hz <= high_hz",
                    low_hz, high_hz));
  }
}

ShakenMotion::ShakenMotion(std::shared_ptr<const CameraMotion> motion, const ShakeOptions& options,
                           std::uint64_t seed)
    : motion_(std::move(motion)) {
  options.Check();
  const NoiseBand band = {options.low_hz, options.high_hz, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    translation_[i] = BandNoise(MixSeeds(seed, kFirstStream + i), band, options.translation_m);
    rotation_[i] = BandNoise(MixSeeds(seed, kFirstStream + 3 + i), band,
                             options.rotation_deg * std::numbers::pi / 180.0);
  }
}

Rigid3d ShakenMotion::WorldFromCam(double time_s) const {
  const double time = std::clamp(time_s, 0.0, DurationS());
  const Eigen::Vector3d turn = Value(rotation_, time);
  const double angle = turn.norm();
  const Eigen::Vector3d axis =
      angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX();
  return motion_->WorldFromCam(time) *
         Rigid3d(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)), Value(translation_, time));
}

}  // namespace lift_slam
