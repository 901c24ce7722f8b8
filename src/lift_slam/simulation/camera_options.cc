#include "lift_slam/simulation/camera_options.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::string_view kModelNames[] = {"pinhole", "radial_tangential", "kannala_brandt",
                                            "fov"};
constexpr int kMaxSide = 16384;

Distortion DistortionOf(const CameraOptions& options) {
  switch (options.model) {
    case CameraModel::kPinhole:
      break;
    case CameraModel::kRadialTangential:
      return RadialTangential{options.k1, options.k2, options.p1, options.p2, options.k3};
    case CameraModel::kKannalaBrandt:
      return KannalaBrandt{options.k1, options.k2, options.k3, options.k4};
    case CameraModel::kFieldOfView:
      return FieldOfView{options.omega};
  }
  return NoDistortion{};
}

}  // namespace

void CameraOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("model", model, kModelNames, "of the distortion");
  visitor.Field("width", width, "pixels");
  visitor.Field("height", height, "pixels");
  visitor.Field("fx", fx, "focal length, pixels");
  visitor.Field("fy", fy, "focal length, pixels");
  visitor.Field("cx", cx, "principal point; (0, 0) is the top-left pixel's centre");
  visitor.Field("cy", cy, "principal point");
  visitor.Field("k1", k1, "distortion, radial");
  visitor.Field("k2", k2, "distortion, radial");
  visitor.Field("k3", k3, "distortion, radial");
  visitor.Field("k4", k4, "distortion of kannala_brandt");
  visitor.Field("p1", p1, "distortion, tangential");
  visitor.Field("p2", p2, "distortion, tangential");
  visitor.Field("omega", omega, "distortion of fov, radians");
  visitor.Field("rate_hz", rate_hz, "images a second");
}

void CameraOptions::Check() const {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw InputError(fmt::format("the image size is {}x{}, expected 1x1 to {}x{} pixels", width,
                                 height, kMaxSide, kMaxSide));
  }
  if (!(rate_hz > 0.0) || rate_hz > 1e5) {
    throw InputError(
        fmt::format("camera.rate_hz is {}, expected more than 0 images a second", rate_hz));
  }
  ToCamera().Check();
}

Camera CameraOptions::ToCamera() const {
  Camera camera;
  camera.pinhole = {fx, fy, cx, cy, width, height};
  camera.distortion = DistortionOf(*this);
  camera.frame_rate_hz = rate_hz;
  camera.source = "the camera to render with";
  return camera;
}

void CameraOptions::Set(const Camera& camera) {
  const PinholeIntrinsics& pinhole = camera.pinhole;
  width = pinhole.width;
  height = pinhole.height;
  fx = pinhole.fx;
  fy = pinhole.fy;
  cx = pinhole.cx;
  cy = pinhole.cy;
  k1 = k2 = k3 = k4 = p1 = p2 = omega = 0.0;
  model = static_cast<CameraModel>(camera.distortion.index());
  if (const auto* d = std::get_if<RadialTangential>(&camera.distortion)) {
    k1 = d->k1, k2 = d->k2, p1 = d->p1, p2 = d->p2, k3 = d->k3;
  } else if (const auto* fisheye = std::get_if<KannalaBrandt>(&camera.distortion)) {
    k1 = fisheye->k1, k2 = fisheye->k2, k3 = fisheye->k3, k4 = fisheye->k4;
  } else if (const auto* fov = std::get_if<FieldOfView>(&camera.distortion)) {
    omega = fov->omega;
  }
  if (camera.frame_rate_hz > 0.0) rate_hz = camera.frame_rate_hz;
}

void CameraOptions::ScaleTo(int new_width, int new_height) {
  if (new_width < 1 || new_height < 1) {
    throw InputError(fmt::format("the image size is {}x{}, expected at least 1x1 pixels", new_width,
                                 new_height));
  }
  if (width < 1 || height < 1) {
    // A calibration without size is taken as of the new one.
    width = new_width, height = new_height;
    return;
  }
  const double scale = static_cast<double>(new_width) / width;
  fx *= scale;
  fy *= scale;
  // From the image centre; (0, 0) is a pixel's centre.
  cx = 0.5 * (new_width - 1) + scale * (cx - 0.5 * (width - 1));
  cy = 0.5 * (new_height - 1) + scale * (cy - 0.5 * (height - 1));
  width = new_width;
  height = new_height;
}

}  // namespace lift_slam
