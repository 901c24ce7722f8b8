#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/datasets/text_table.h"

namespace lift_slam {

// One rectified KITTI camera: P = K [I | offset], x_in_cam = x_in_cam0 + offset.
struct KittiProjection {
  Camera camera;  // without distortion; its size is 0 when the file gives none
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // metres
};

// The row "P<i>:" (calib.txt) or "P_rect_0<i>:" (calib_cam_to_cam.txt), where i is the last digit
// of the camera's name (image_2, image_02), 0 when it has none. Nothing when there is no such row.
std::optional<std::string> FindKittiProjectionRow(const std::vector<TableRow>& rows,
                                                  std::string_view camera_name);

// Throws InputError when the row is malformed.
KittiProjection ReadKittiProjection(const std::filesystem::path& path, const std::string& row_name);

// The camera before rectification (calib_cam_to_cam.txt: S_0i, K_0i, D_0i).
Camera ReadKittiUnrectified(const std::filesystem::path& path, std::string_view camera_name);

}  // namespace lift_slam
