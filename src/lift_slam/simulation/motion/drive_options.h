#pragma once

#include "lift_slam/util/options.h"

namespace lift_slam {

// How fast a car goes along a road.
struct SpeedOptions {
  double top_m_s = 12.0;  // 1.2 m a frame at 10 frames/s
  bool constant = false;  // the top speed all the time, whatever the curves
  // The limits below make a calm driver; lateral: in curves, seen from above.
  double max_lateral_m_s2 = 2.5;
  double max_acceleration_m_s2 = 1.5;
  double max_deceleration_m_s2 = 2.5;
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// A car's camera on a road that is a closed loop. Ways of a wander are of the full size: twice an
// amplitude from side to side.
struct DriveOptions {
  double laps = 1.0;                  // may be a fraction
  double extra_m = 0.0;               // driven after the laps
  double start_m = 0.0;               // where on the loop, from its first cross-section
  bool reverse = false;               // against the road's direction
  double height_m = 1.65;             // of the camera above the road (KITTI's car)
  double pitch_down_deg = 0.0;        // how the camera is mounted
  double lateral_amplitude_m = 0.6;   // most that the car strays from the centre line
  double lateral_wavelength_m = 150;  // typical length of one swing
  double edge_margin_m = 1.2;         // the camera keeps so far from the road's edge
  double heading_amplitude_deg = 0.5;
  double heading_wavelength_m = 60;
  double road_smoothing_m = 4.0;  // the centre line is averaged over about so much
  // Suspension: root mean square at top speed, less when slower, none at rest.
  double bump_height_m = 0.008;
  double bump_pitch_deg = 0.20;
  double bump_roll_deg = 0.20;
  double bump_frequency_hz = 1.5;  // of a car body on its springs
  SpeedOptions speed;
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

}  // namespace lift_slam
