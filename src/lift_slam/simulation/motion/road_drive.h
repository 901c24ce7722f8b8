#pragma once

#include <cstdint>

#include "lift_slam/simulation/motion/band_noise.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/simulation/motion/drive_options.h"
#include "lift_slam/simulation/motion/road_path.h"
#include "lift_slam/simulation/motion/speed_profile.h"

namespace lift_slam {

// A camera on a car that drives along a road: wandering within it, braking in curves, following
// slope and banking, swaying on its springs. A second lap wanders otherwise than the first, and
// nothing jumps where the loop closes. The same seed gives the same drive.
class RoadDrive : public CameraMotion {
 public:
  // Throws InputError for options out of range and for a road that is none (RoadPath).
  RoadDrive(const Road& road, const DriveOptions& options, std::uint64_t seed);
  RoadDrive(const RoadDrive&) = delete;
  RoadDrive& operator=(const RoadDrive&) = delete;

  Rigid3d WorldFromCam(double time_s) const override;
  double DurationS() const override { return distance_.DurationS(); }

  double LengthM() const { return length_m_; }  // of the whole drive
  const RoadPath& path() const { return path_; }
  double DistanceM(double time_s) const { return distance_.DistanceM(time_s); }
  double SpeedM_s(double time_s) const { return distance_.SpeedM_s(time_s); }
  // To the left of the centre line after a distance of the drive.
  double LateralOffsetM(double distance_m) const;

 private:
  // World from the car's body, an untilted camera.
  Rigid3d WorldFromBody(double distance_m) const;

  DriveOptions options_;
  RoadPath path_;
  double length_m_;
  SpeedProfile speed_;
  DistanceOverTime distance_;
  double lateral_limit_m_;
  BandNoise lateral_, heading_;                     // by distance
  BandNoise bump_height_, bump_pitch_, bump_roll_;  // by time
};

}  // namespace lift_slam
