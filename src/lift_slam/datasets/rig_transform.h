#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// Where the camera sits on the body (IMU): T_BS of EuRoC's sensor.yaml, the inverse of Kalibr's
// T_cam_imu, or ORB-SLAM3's Tbc or IMU.T_b_c1. Nothing when the file has none of them or is no
// YAML. Throws InputError when it is no rigid transform.
std::optional<Rigid3d> ReadBodyFromCamera(const std::filesystem::path& file,
                                          std::string_view camera_name);

}  // namespace lift_slam
