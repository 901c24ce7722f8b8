#include "lift_slam/datasets/camera_file.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/datasets/camera_formats.h"
#include "lift_slam/datasets/frame_rate.h"
#include "lift_slam/datasets/kitti_calibration.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

Camera ReadKeyedCamera(const KeyedFile& file, std::string_view camera_name) {
  if (file.Has("model")) return ReadOwnCamera(file);
  if (file.Has("camera_matrix") || file.HasGroup("camera_matrix")) return ReadOpenCvCamera(file);
  if (file.HasGroup("cam0")) return ReadKalibrCamera(file, camera_name);
  if (file.Has("Camera.fx") || file.Has("Camera1.fx")) return ReadOrbSlamCamera(file);
  if (file.Has("intrinsics")) return ReadEurocCamera(file);
  throw InputError(fmt::format(
      "{}: no known camera calibration: it has none of the keys model (own format), camera_matrix "
      "(OpenCV, ROS), cam0 (Kalibr), Camera.fx or Camera1.fx (ORB-SLAM), intrinsics (EuRoC); the "
      "least that is needed is {}",
      file.source(), kCameraFileExample));
}

// The layouts that are no YAML; nothing when the file is none of them.
std::optional<Camera> ReadTextCamera(const fs::path& path, std::string_view camera_name) {
  const std::vector<TableRow> rows = ReadTable(path);
  if (rows.empty()) throw InputError(fmt::format("{}: the file is empty", path.string()));
  if (IsColmapCameraRow(rows.front())) return ReadColmapCamera(rows, path);
  if (IsTumMonoCameraRow(rows.front())) return ReadTumMonoCamera(rows, path);
  if (const auto row = FindKittiProjectionRow(rows, camera_name)) {
    return ReadKittiProjection(path, *row).camera;
  }
  return std::nullopt;
}

struct DistortionYaml {
  std::string operator()(const NoDistortion&) const { return "model: pinhole\n"; }
  std::string operator()(const RadialTangential& d) const {
    return fmt::format("model: radial_tangential\nk1: {}\nk2: {}\np1: {}\np2: {}\nk3: {}\n", d.k1,
                       d.k2, d.p1, d.p2, d.k3);
  }
  std::string operator()(const KannalaBrandt& d) const {
    return fmt::format("model: kannala_brandt\nk1: {}\nk2: {}\nk3: {}\nk4: {}\n", d.k1, d.k2, d.k3,
                       d.k4);
  }
  std::string operator()(const FieldOfView& d) const {
    return fmt::format("model: fov\nomega: {}\n", d.omega);
  }
};

struct AllFinite {
  bool operator()(const NoDistortion&) const { return true; }
  bool operator()(const RadialTangential& d) const {
    return std::isfinite(d.k1 + d.k2 + d.p1 + d.p2 + d.k3);
  }
  bool operator()(const KannalaBrandt& d) const { return std::isfinite(d.k1 + d.k2 + d.k3 + d.k4); }
  bool operator()(const FieldOfView& d) const { return std::isfinite(d.omega) && d.omega >= 0.0; }
};

}  // namespace

Camera ReadCameraFile(const fs::path& path, std::string_view camera_name) {
  if (!fs::is_regular_file(path)) {
    throw InputError(fmt::format("{}: no such camera file", path.string()));
  }
  std::optional<Camera> camera;
  if (path.extension() == ".xml") {
    camera = ReadKeyedCamera(KeyedFile::ReadXml(path), camera_name);
  } else {
    camera = ReadTextCamera(path, camera_name);
    if (!camera) camera = ReadKeyedCamera(KeyedFile::ReadYaml(path), camera_name);
  }
  camera->source = path.string();
  CheckCalibration(*camera);
  return *camera;
}

void WriteCameraFile(const fs::path& path, const Camera& camera) {
  const PinholeIntrinsics& p = camera.pinhole;
  std::string text = "# Pixel (0, 0) is the centre of the top-left pixel.\n";
  text += std::visit(DistortionYaml(), camera.distortion);
  text += fmt::format("width: {}\nheight: {}\nfx: {}\nfy: {}\ncx: {}\ncy: {}\n", p.width, p.height,
                      p.fx, p.fy, p.cx, p.cy);
  if (IsFrameRate(camera.frame_rate_hz))
    text += fmt::format("frame_rate_hz: {}\n", camera.frame_rate_hz);
  WriteTextAtomically(path, text);
}

const std::vector<std::string>& CameraFileNames() {
  static const std::vector<std::string> names = {
      "camera.yaml", "camera.yml",    "calibration.yaml", "calibration.yml",
      "camera.xml",  "camchain.yaml", "cameras.txt"};
  return names;
}

std::optional<fs::path> FindCameraFile(const fs::path& folder) {
  for (const std::string& name : CameraFileNames()) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  return std::nullopt;
}

void CheckCalibration(const Camera& camera) {
  const PinholeIntrinsics& p = camera.pinhole;
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", camera.source, what));
  };
  if (!(p.fx > 0.0 && p.fy > 0.0) || !std::isfinite(p.fx + p.fy)) {
    fail(fmt::format("expected positive focal lengths, found fx {} and fy {}", p.fx, p.fy));
  }
  if (p.width < 0 || p.height < 0) {
    fail(fmt::format("expected a positive image size, found {}x{}", p.width, p.height));
  }
  if (!std::isfinite(p.cx + p.cy)) fail("the principal point is not finite");
  const bool outside = p.cx < 0.0 || p.cy < 0.0 || (p.width > 0 && p.cx > p.width - 1) ||
                       (p.height > 0 && p.cy > p.height - 1);
  if (outside) {
    fail(fmt::format("the principal point ({}, {}) lies outside the image of {}x{} pixels", p.cx,
                     p.cy, p.width, p.height));
  }
  if (!std::visit(AllFinite(), camera.distortion)) fail("a distortion coefficient is not valid");
}

}  // namespace lift_slam
