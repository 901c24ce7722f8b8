#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "lift_slam/simulation/motion/band_noise.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Trembling of a camera held in the hand: each of its six degrees of freedom, root mean square.
struct ShakeOptions {
  double translation_m = 0.0;
  double rotation_deg = 0.0;
  double low_hz = 0.5;
  double high_hz = 8.0;  // amplitudes fall with the frequency
  bool IsOff() const { return translation_m == 0.0 && rotation_deg == 0.0; }
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// Another motion, shaken.
class ShakenMotion : public CameraMotion {
 public:
  ShakenMotion(std::shared_ptr<const CameraMotion> motion, const ShakeOptions& options,
               std::uint64_t seed);

  Rigid3d WorldFromCam(double time_s) const override;
  double DurationS() const override { return motion_->DurationS(); }

 private:
  std::shared_ptr<const CameraMotion> motion_;
  std::array<BandNoise, 3> translation_;  // along the camera's axes
  std::array<BandNoise, 3> rotation_;     // rotation vector, camera's axes
};

}  // namespace lift_slam
