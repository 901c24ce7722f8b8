#pragma once

#include "lift_slam/util/options.h"

namespace lift_slam {

// What a real sensor does to a perfect picture, in the order of physics. Each is off by default.

struct MotionBlurOptions {
  double exposure_s = 0.0;  // 0: none; the exposure's middle is the frame's time
  int samples = 9;          // pictures averaged over it; odd, so that one is of the frame's pose
};

struct RollingShutterOptions {
  double readout_s = 0.0;  // from the first to the last row; 0: none; the middle row is on time
  int bands = 16;          // of rows that share a pose
};

struct ExposureOptions {
  double swing_ev = 0.0;  // amplitude of a slow swing, in powers of two
  double swing_period_s = 8.0;
  double jump_ev = 0.0;  // most that sudden jumps deviate, to either side
  double jump_interval_s = 5.0;
};

struct NoiseOptions {
  double full_well_electrons = 0.0;  // of a white pixel: shot noise; 0: no noise at all
  double read_electrons = 4.0;       // read-out noise, root mean square
};

struct SensorOptions {
  MotionBlurOptions motion_blur;
  RollingShutterOptions rolling_shutter;
  double vignetting = 0.0;  // share of the light that is lost in the corners
  ExposureOptions exposure;
  NoiseOptions noise;
  // The tone curve is value = light ^ (1 / gamma); with 2.2 the scene's pictures stay as they are.
  double gamma = 2.2;
  double gamma_swing = 0.0;  // amplitude of a slow swing of it
  double gamma_period_s = 11.0;
  double salt_and_pepper = 0.0;  // share of pixels that are black or white

  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

}  // namespace lift_slam
