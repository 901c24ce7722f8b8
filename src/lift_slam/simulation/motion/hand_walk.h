#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "lift_slam/simulation/motion/band_noise.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Where a walking person looks.
enum class WalkGaze { kAhead, kCenter, kOutward };

// A walk with a camera in the hand around the middle of a room, along an ellipse.
struct WalkOptions {
  double laps = 1.0;         // rounds; may be a fraction
  double speed_m_s = 1.0;    // on average
  double height_m = 1.6;     // of the camera above the lowest point of the box
  double reach = 0.5;        // the ellipse's size as a share of the box
  double bobbing_m = 0.015;  // up and down with each step, amplitude
  double step_frequency_hz = 1.8;
  WalkGaze gaze = WalkGaze::kAhead;
  double look_around_deg = 20.0;  // most that the gaze wanders to a side
  double look_period_s = 6.0;     // typical time of one swing
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

class HandWalk : public CameraMotion {
 public:
  // Within `box` (scene frame, z up). Throws InputError for options out of range or an empty box.
  HandWalk(const Eigen::AlignedBox3d& box, const WalkOptions& options, std::uint64_t seed);

  Rigid3d WorldFromCam(double time_s) const override;
  double DurationS() const override { return duration_s_; }

 private:
  // Yaw of the gaze, radians from x towards y, before it wanders.
  double GazeYaw(double phase) const;

  Eigen::AlignedBox3d box_;
  WalkOptions options_;
  Eigen::Vector2d center_, radii_;
  double duration_s_ = 0.0;
  double start_phase_ = 0.0;
  BandNoise yaw_, pitch_;
};

}  // namespace lift_slam
