#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/camera/camera.h"

namespace lift_slam {

// A calibration that fits on one line, for messages.
inline constexpr std::string_view kCameraFileExample =
    "{model: pinhole, width: 640, height: 480, fx: 525, fy: 525, cx: 319.5, cy: 239.5}";

// Reads a calibration, whose kind is found out from its content:
//   own YAML (`model:`), OpenCV FileStorage YAML, XML or JSON and ROS camera_info
//   (`camera_matrix`), Kalibr camchain (`cam0:`), EuRoC sensor.yaml, ORB-SLAM2/3 settings
//   (`Camera.fx` or `Camera1.fx`), COLMAP cameras.txt, TUM-mono camera.txt, KITTI calib.txt and
//   calib_cam_to_cam.txt.
// The result has pixel (0, 0) at the centre of the top-left pixel whatever the file's convention.
// `camera_name` picks one of a rig (Kalibr cam0, cam1; KITTI image_0 to image_3); empty: the
// first. Width and height are 0 when the file does not give them.
// Throws InputError that names file and key when something is missing, malformed or of a model
// that is not supported.
Camera ReadCameraFile(const std::filesystem::path& path, std::string_view camera_name = {});

// Our own YAML; reading it back gives the same numbers. A frame rate outside 1e-3 to 1e5 Hz, which
// could not be read, is left out as unknown.
void WriteCameraFile(const std::filesystem::path& path, const Camera& camera);

// The first of these names that exists in a folder: camera.yaml, camera.yml, calibration.yaml,
// calibration.yml, camera.xml, camchain.yaml, cameras.txt.
std::optional<std::filesystem::path> FindCameraFile(const std::filesystem::path& folder);
const std::vector<std::string>& CameraFileNames();

// Throws InputError naming the source when a focal length is not positive, a size is negative, a
// number is not finite or the principal point lies outside an image of known size.
void CheckCalibration(const Camera& camera);

}  // namespace lift_slam
