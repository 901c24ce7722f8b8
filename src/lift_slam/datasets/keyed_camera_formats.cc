// The camera files that are tables of keys: our own, OpenCV and ROS, Kalibr, EuRoC, ORB-SLAM.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/datasets/camera_formats.h"
#include "lift_slam/datasets/distortion_keys.h"
#include "lift_slam/datasets/frame_rate.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

PinholeIntrinsics MakePinhole(std::span<const double> fx_fy_cx_cy, int width, int height) {
  LIFT_SLAM_CHECK(fx_fy_cx_cy.size() == 4, "{} intrinsics", fx_fy_cx_cy.size());
  return {fx_fy_cx_cy[0], fx_fy_cx_cy[1], fx_fy_cx_cy[2], fx_fy_cx_cy[3], width, height};
}

// Values named by single keys; an absent one is zero.
std::vector<double> ReadNamed(const KeyedFile& file, const std::string& prefix,
                              const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names) values.push_back(file.NumberOr(prefix + name, 0.0));
  return values;
}

// 0 when the file does not say it, or says 0.
double ReadFrameRate(const KeyedFile& file, const std::string& key) {
  const double rate_hz = file.NumberOr(key, 0.0);
  if (rate_hz != 0.0 && !IsFrameRate(rate_hz)) {
    file.Fail(key, fmt::format("{} to {} frames/s", kMinFrameRateHz, kMaxFrameRateHz));
  }
  return rate_hz;
}

bool AllZero(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
}

// The values of a list that may lie under `key` or, as OpenCV and ROS write, under `key`/data.
std::string MatrixKey(const KeyedFile& file, const std::string& key) {
  return file.Has(key + "/data") ? key + "/data" : key;
}

bool NamesFisheye(const KeyedFile& file) {
  if (file.WholeNumberOr("fisheye_model", 0) != 0) return true;
  if (!file.Has("distortion_model")) return false;
  const std::string model = file.Text("distortion_model");
  return model == "equidistant" || model == "fisheye";
}

bool IsFisheye(const KeyedFile& file) {
  if (NamesFisheye(file)) return true;
  if (!file.Has("distortion_model")) return false;
  const std::string model = file.Text("distortion_model");
  if (model == "plumb_bob" || model == "rational_polynomial" || model == "radtan") return false;
  file.Fail("distortion_model", "plumb_bob, rational_polynomial, equidistant or fisheye");
}

// The parts of a rig calibration that Kalibr and EuRoC name differently.
Distortion ReadNamedDistortion(const KeyedFile& file, const std::string& model_key,
                               const std::string& coefficients_key) {
  const std::string given = MatrixKey(file, coefficients_key);
  if (!file.Has(model_key) && file.Has(given) && !file.AllZero(given)) {
    file.Fail(given, fmt::format("a key '{}' beside it that names the model: radtan "
                                 "(radial-tangential), equidistant, fov or none",
                                 model_key));
  }
  const std::string model = file.Has(model_key) ? file.Text(model_key) : "none";
  if (model == "none") return NoDistortion{};
  if (model == "radtan" || model == "radial-tangential") {
    const std::vector<double> values = file.Numbers(coefficients_key);
    if (values.size() != 4 && values.size() != 5) file.Fail(coefficients_key, "4 or 5 numbers");
    return MakeRadialTangential(values);
  }
  if (model == "equidistant") return MakeKannalaBrandt(file.Numbers(coefficients_key, 4));
  if (model == "fov") return FieldOfView{file.Numbers(coefficients_key, 1).front()};
  file.Fail(model_key, "radtan (radial-tangential), equidistant, fov or none");
}

Camera ReadRigCamera(const KeyedFile& file, const std::string& prefix,
                     const std::string& coefficients_key) {
  const std::string model_key = prefix + "camera_model";
  if (file.Has(model_key) && file.Text(model_key) != "pinhole") {
    file.Fail(model_key, "pinhole (other projections are not supported)");
  }
  const std::vector<int> size = file.Has(prefix + "resolution")
                                    ? file.WholeNumbers(prefix + "resolution", 2)
                                    : std::vector<int>{0, 0};
  Camera camera;
  camera.pinhole = MakePinhole(file.Numbers(prefix + "intrinsics", 4), size[0], size[1]);
  RefuseOtherDistortionKeys(file, prefix, {coefficients_key, "distortion_model"});
  camera.distortion =
      ReadNamedDistortion(file, prefix + "distortion_model", prefix + coefficients_key);
  return camera;
}

std::vector<double> ReadOrbSlamCoefficients(const KeyedFile& file, const std::string& prefix,
                                            const std::vector<std::string>& names) {
  RefuseOtherOrbSlamCoefficients(file, prefix, names);
  return ReadNamed(file, prefix, names);
}

}  // namespace

Distortion MakeRadialTangential(std::span<const double> c) {
  LIFT_SLAM_CHECK(c.size() >= 4, "{} coefficients", c.size());
  if (AllZero(c)) return NoDistortion{};
  return RadialTangential{c[0], c[1], c[2], c[3], c.size() > 4 ? c[4] : 0.0};
}

Distortion MakeKannalaBrandt(std::span<const double> c) {
  LIFT_SLAM_CHECK(c.size() == 4, "{} coefficients", c.size());
  return KannalaBrandt{c[0], c[1], c[2], c[3]};
}

Camera ReadOwnCamera(const KeyedFile& file) {
  const std::string model = file.Text("model");
  std::vector<std::string> known = {"model", "width", "height", "fx", "fy", "cx", "cy"};
  Camera camera;
  if (model == "pinhole") {
    camera.distortion = NoDistortion{};
  } else if (model == "radial_tangential") {
    known.insert(known.end(), {"k1", "k2", "p1", "p2", "k3"});
    const auto k = ReadNamed(file, "", {"k1", "k2", "p1", "p2", "k3"});
    camera.distortion = RadialTangential{k[0], k[1], k[2], k[3], k[4]};
  } else if (model == "kannala_brandt") {
    known.insert(known.end(), {"k1", "k2", "k3", "k4"});
    camera.distortion = MakeKannalaBrandt(ReadNamed(file, "", {"k1", "k2", "k3", "k4"}));
  } else if (model == "fov") {
    known.push_back("omega");
    camera.distortion = FieldOfView{file.Number("omega")};
  } else {
    file.Fail("model", "pinhole, radial_tangential, kannala_brandt or fov");
  }
  known.push_back("frame_rate_hz");
  for (const std::string& key : file.Keys()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    file.Fail(key, fmt::format("no such key; the model {} has {}", model, fmt::join(known, ", ")));
  }
  const std::vector<double> intrinsics = {file.Number("fx"), file.Number("fy"), file.Number("cx"),
                                          file.Number("cy")};
  camera.pinhole = MakePinhole(intrinsics, file.WholeNumber("width"), file.WholeNumber("height"));
  camera.frame_rate_hz = ReadFrameRate(file, "frame_rate_hz");
  return camera;
}

Camera ReadOpenCvCamera(const KeyedFile& file) {
  const std::string matrix_key = MatrixKey(file, "camera_matrix");
  const std::vector<double> matrix = file.Numbers(matrix_key, 9);
  const std::vector<double> intrinsics = {matrix[0], matrix[4], matrix[2], matrix[5]};
  Camera camera;
  camera.pinhole = MakePinhole(intrinsics, file.WholeNumberOr("image_width", 0),
                               file.WholeNumberOr("image_height", 0));
  RefuseOtherDistortionKeys(file, "", {"distortion_coefficients", "distortion_model"});
  const std::string key = MatrixKey(file, "distortion_coefficients");
  if (!file.Has(key) && !NamesFisheye(file)) return camera;
  const std::vector<double> coefficients = file.Numbers(key);
  if (IsFisheye(file)) {
    if (coefficients.size() != 4) file.Fail(key, "4 numbers (fisheye)");
    camera.distortion = MakeKannalaBrandt(coefficients);
    return camera;
  }
  if (coefficients.empty()) return camera;
  if (coefficients.size() < 4) file.Fail(key, "at least 4 numbers");
  const std::span<const double> all = coefficients;
  if (all.size() > 5 && !AllZero(all.subspan(5))) {
    file.Fail(key,
              "k1 k2 p1 p2 k3 only (the rational, thin prism and tilted models are not "
              "supported)");
  }
  camera.distortion = MakeRadialTangential(all.first(std::min<std::size_t>(5, all.size())));
  return camera;
}

Camera ReadKalibrCamera(const KeyedFile& file, std::string_view camera_name) {
  const std::string name = camera_name.starts_with("cam") ? std::string(camera_name) : "cam0";
  if (!file.HasGroup(name)) {
    throw InputError(fmt::format("{}: there is no camera '{}' in it", file.source(), name));
  }
  return ReadRigCamera(file, name + "/", "distortion_coeffs");
}

Camera ReadEurocCamera(const KeyedFile& file) {
  Camera camera = ReadRigCamera(file, "", "distortion_coefficients");
  camera.frame_rate_hz = ReadFrameRate(file, "rate_hz");
  return camera;
}

Camera ReadOrbSlamCamera(const KeyedFile& file) {
  const std::string prefix = file.Has("Camera1.fx") ? "Camera1." : "Camera.";
  Camera camera;
  const std::vector<double> intrinsics = {file.Number(prefix + "fx"), file.Number(prefix + "fy"),
                                          file.Number(prefix + "cx"), file.Number(prefix + "cy")};
  camera.pinhole = MakePinhole(intrinsics, file.WholeNumberOr("Camera.width", 0),
                               file.WholeNumberOr("Camera.height", 0));
  camera.frame_rate_hz = ReadFrameRate(file, "Camera.fps");
  const std::string type = file.Has("Camera.type") ? file.Text("Camera.type") : "PinHole";
  if (type == "KannalaBrandt8") {
    camera.distortion =
        MakeKannalaBrandt(ReadOrbSlamCoefficients(file, prefix, {"k1", "k2", "k3", "k4"}));
  } else if (type == "PinHole" || type == "Pinhole") {
    camera.distortion =
        MakeRadialTangential(ReadOrbSlamCoefficients(file, prefix, {"k1", "k2", "p1", "p2", "k3"}));
  } else if (type != "Rectified") {
    file.Fail("Camera.type", "PinHole, Rectified or KannalaBrandt8");
  }
  return camera;
}

}  // namespace lift_slam
