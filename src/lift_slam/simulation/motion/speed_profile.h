#pragma once

#include <functional>
#include <vector>

#include "lift_slam/simulation/motion/drive_options.h"
#include "lift_slam/simulation/motion/periodic_spline.h"

namespace lift_slam {

// The speed at every place of a closed road within all limits of SpeedOptions: the car brakes
// before curves and speeds up after them. It goes around the loop without a seam, and v^2 is twice
// continuously differentiable by the distance, so the acceleration does not jump.
class SpeedProfile {
 public:
  // `curvature_per_m` of the way at a distance along the loop.
  SpeedProfile(const std::function<double(double)>& curvature_per_m, double length_m,
               const SpeedOptions& options);

  double SpeedAt(double distance_m) const;
  // Along the way, m/s^2; negative: braking.
  double AccelerationAt(double distance_m) const;

 private:
  PeriodicSpline squared_speed_;  // x: v^2
};

// How far a car is on its way after a time.
class DistanceOverTime {
 public:
  // From `start_m` of the loop on, for `length_m`.
  DistanceOverTime(const SpeedProfile& profile, double start_m, double length_m);

  double DurationS() const { return duration_s_; }
  // Driven since the start; continuous with its derivative, the speed. Clamped to the way.
  double DistanceM(double time_s) const;
  double SpeedM_s(double time_s) const;

 private:
  const SpeedProfile& profile_;
  double start_m_, length_m_;
  double duration_s_ = 0.0;
  std::vector<double> distances_m_;  // at multiples of a fixed step of time
};

}  // namespace lift_slam
