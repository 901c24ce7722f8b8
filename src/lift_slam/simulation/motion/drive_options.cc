#include "lift_slam/simulation/motion/drive_options.h"

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
void SpeedOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("top_m_s", top_m_s, "top speed");
  visitor.Field("constant", constant, "always the top speed, whatever the curves");
  visitor.Field("max_lateral_m_s2", max_lateral_m_s2, "acceleration in curves");
  visitor.Field("max_acceleration_m_s2", max_acceleration_m_s2, "speeding up");
  visitor.Field("max_deceleration_m_s2", max_deceleration_m_s2, "braking");
}

void SpeedOptions::Check() const {
  CheckOptionRange("drive.speed.top_m_s", top_m_s, 0.01, 200.0);
  CheckOptionRange("drive.speed.max_lateral_m_s2", max_lateral_m_s2, 0.01, 100.0);
  CheckOptionRange("drive.speed.max_acceleration_m_s2", max_acceleration_m_s2, 0.01, 100.0);
  CheckOptionRange("drive.speed.max_deceleration_m_s2", max_deceleration_m_s2, 0.01, 100.0);
}

void DriveOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("laps", laps, "rounds of the road; may be a fraction");
  visitor.Field("extra_m", extra_m, "driven after the laps");
  visitor.Field("start_m", start_m, "where on the loop the drive begins");
  visitor.Field("reverse", reverse, "against the road's direction");
  visitor.Field("height_m", height_m, "of the camera above the road");
  visitor.Field("pitch_down_deg", pitch_down_deg, "how the camera is mounted");
  visitor.Field("lateral_amplitude_m", lateral_amplitude_m,
                "most that the car strays from the centre line");
  visitor.Field("lateral_wavelength_m", lateral_wavelength_m, "typical length of one swing");
  visitor.Field("edge_margin_m", edge_margin_m, "least distance from the road's edge");
  visitor.Field("heading_amplitude_deg", heading_amplitude_deg,
                "most that the camera looks beside the direction of travel");
  visitor.Field("heading_wavelength_m", heading_wavelength_m, "typical length of one swing");
  visitor.Field("road_smoothing_m", road_smoothing_m,
                "the centre line is averaged over about so much");
  visitor.Field("bump_height_m", bump_height_m, "suspension, root mean square at top speed");
  visitor.Field("bump_pitch_deg", bump_pitch_deg, "suspension, root mean square at top speed");
  visitor.Field("bump_roll_deg", bump_roll_deg, "suspension, root mean square at top speed");
  visitor.Field("bump_frequency_hz", bump_frequency_hz, "of the car's body on its springs");
  visitor.Group("speed", speed, "speed profile");
}

void DriveOptions::Check() const {
  CheckOptionRange("drive.laps", laps, 0.0, 100.0);
  CheckOptionRange("drive.extra_m", extra_m, 0.0, 1e5);
  if (laps == 0.0 && extra_m == 0.0) {
    throw InputError("drive.laps and drive.extra_m are both 0, expected a way to drive");
  }
  CheckOptionRange("drive.start_m", start_m, 0.0, 1e6);
  CheckOptionRange("drive.height_m", height_m, 0.01, 1000.0);
  CheckOptionRange("drive.pitch_down_deg", pitch_down_deg, -90.0, 90.0);
  CheckOptionRange("drive.lateral_amplitude_m", lateral_amplitude_m, 0.0, 100.0);
  CheckOptionRange("drive.lateral_wavelength_m", lateral_wavelength_m, 5.0, 1e5);
  CheckOptionRange("drive.edge_margin_m", edge_margin_m, 0.0, 100.0);
  CheckOptionRange("drive.heading_amplitude_deg", heading_amplitude_deg, 0.0, 90.0);
  CheckOptionRange("drive.heading_wavelength_m", heading_wavelength_m, 5.0, 1e5);
  CheckOptionRange("drive.road_smoothing_m", road_smoothing_m, 0.5, 50.0);
  CheckOptionRange("drive.bump_height_m", bump_height_m, 0.0, 1.0);
  CheckOptionRange("drive.bump_pitch_deg", bump_pitch_deg, 0.0, 20.0);
  CheckOptionRange("drive.bump_roll_deg", bump_roll_deg, 0.0, 20.0);
  CheckOptionRange("drive.bump_frequency_hz", bump_frequency_hz, 0.05, 20.0);
  speed.Check();
}

}  // namespace lift_slam
