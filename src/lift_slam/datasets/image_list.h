#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/geometry/trajectory_io.h"

namespace lift_slam {

struct ListedImage {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;
  std::filesystem::path file;
};

// The truth that lies with a sequence.
struct TruthFile {
  std::filesystem::path path;
  TrajectoryFormat format = TrajectoryFormat::kTum;
  NanRows nan_rows = NanRows::kRefuse;
};

// The format of a file of poses. Throws InputError when it is none or holds no pose.
TrajectoryFormat DetectTruthFormat(const std::filesystem::path& path);

// What the files of a sequence folder say, before an image is opened.
struct ImageList {
  std::vector<ListedImage> images;  // in the order of the recording
  std::optional<Camera> camera;
  std::string calibration_searched;  // where it was looked for, for the message when it is missing
  std::optional<TruthFile> truth;
  // The frame that the truth's poses are of (EuRoC's body, KITTI's camera 0) from the camera.
  std::optional<Rigid3d> truth_from_cam;
  std::vector<std::string> warnings;
};

struct LayoutRequest {
  std::filesystem::path folder;  // absolute
  const SequenceOptions& options;
  std::optional<Camera> given_camera;  // from options.camera_file; the own calibration is not read
};

// One reader for each layout. All throw InputError for missing or malformed files.
ImageList ListKittiOdometry(const LayoutRequest& request);
ImageList ListKittiRaw(const LayoutRequest& request);
ImageList ListEuroc(const LayoutRequest& request);
ImageList ListTumRgbd(const LayoutRequest& request);
ImageList ListTumMono(const LayoutRequest& request);
ImageList ListImageFolder(const LayoutRequest& request);

// frame_index / frame_rate_hz; nothing when it does not fit.
std::optional<std::int64_t> NominalTimeNs(std::int64_t frame_index, double frame_rate_hz);

// Gives all images their nominal time. Throws InputError naming the first whose time does not fit.
void AssignNominalTimes(double frame_rate_hz, std::vector<ListedImage>& images);

// The rate of images without times: the option, else the camera's, else `fallback_hz` with a
// warning that starts with `what_is_missing`.
double NominalRate(const LayoutRequest& request, const std::optional<Camera>& camera,
                   double fallback_hz, const std::string& what_is_missing,
                   std::vector<std::string>& warnings);

// The camera folder asked for by options.camera_name, else the first of `names` that exists.
// Throws InputError when there is none. `subfolder` is what must lie in it ("data", or empty).
std::string ChooseCameraFolder(const LayoutRequest& request, const std::vector<std::string>& names,
                               const std::string& subfolder);

}  // namespace lift_slam
