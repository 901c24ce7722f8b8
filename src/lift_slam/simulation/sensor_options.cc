#include "lift_slam/simulation/sensor_options.h"

#include <fmt/format.h>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
void SensorOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("exposure_time_s", motion_blur.exposure_s, "motion blur; 0: none");
  visitor.Field("blur_samples", motion_blur.samples, "pictures averaged for it, an odd number");
  visitor.Field("rolling_readout_s", rolling_shutter.readout_s,
                "rolling shutter, from the first to the last row; 0: none");
  visitor.Field("rolling_bands", rolling_shutter.bands, "of rows that share a pose");
  visitor.Field("vignetting", vignetting, "share of the light that is lost in the corners");
  visitor.Field("exposure_swing_ev", exposure.swing_ev, "slow changes of the exposure, amplitude");
  visitor.Field("exposure_period_s", exposure.swing_period_s, "of these changes");
  visitor.Field("exposure_jump_ev", exposure.jump_ev, "sudden changes of the exposure, at most");
  visitor.Field("exposure_jump_interval_s", exposure.jump_interval_s, "between these, on average");
  visitor.Field("full_well_electrons", noise.full_well_electrons,
                "of a white pixel: less is noisier; 0: no noise");
  visitor.Field("read_electrons", noise.read_electrons, "read-out noise, root mean square");
  visitor.Field("gamma", gamma, "value = light ^ (1 / gamma)");
  visitor.Field("gamma_swing", gamma_swing, "slow changes of gamma, amplitude");
  visitor.Field("gamma_period_s", gamma_period_s, "of these changes");
  visitor.Field("salt_and_pepper", salt_and_pepper, "share of pixels that are black or white");
}

void SensorOptions::Check() const {
  CheckOptionRange("sensor.exposure_time_s", motion_blur.exposure_s, 0.0, 10.0);
  CheckOptionRange("sensor.blur_samples", motion_blur.samples, 1, 999);
  if (motion_blur.samples % 2 == 0) {
    throw InputError(
        fmt::format("sensor.blur_samples is {}, expected an odd number", motion_blur.samples));
  }
  CheckOptionRange("sensor.rolling_readout_s", rolling_shutter.readout_s, 0.0, 10.0);
  CheckOptionRange("sensor.rolling_bands", rolling_shutter.bands, 1, 4096);
  CheckOptionRange("sensor.vignetting", vignetting, 0.0, 1.0);
  CheckOptionRange("sensor.exposure_swing_ev", exposure.swing_ev, 0.0, 10.0);
  CheckOptionRange("sensor.exposure_period_s", exposure.swing_period_s, 1e-3, 1e6);
  CheckOptionRange("sensor.exposure_jump_ev", exposure.jump_ev, 0.0, 10.0);
  CheckOptionRange("sensor.exposure_jump_interval_s", exposure.jump_interval_s, 1e-2, 1e6);
  CheckOptionRange("sensor.full_well_electrons", noise.full_well_electrons, 0.0, 1e9);
  CheckOptionRange("sensor.read_electrons", noise.read_electrons, 0.0, 1e6);
  CheckOptionRange("sensor.gamma", gamma, 0.1, 10.0);
  CheckOptionRange("sensor.gamma_swing", gamma_swing, 0.0, 0.9 * gamma);
  CheckOptionRange("sensor.gamma_period_s", gamma_period_s, 1e-3, 1e6);
  CheckOptionRange("sensor.salt_and_pepper", salt_and_pepper, 0.0, 1.0);
}

}  // namespace lift_slam
