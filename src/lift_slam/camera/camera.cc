#include "lift_slam/camera/camera.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "lift_slam/camera/distortion.h"
#include "lift_slam/camera/undistortion.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The parameters of the model, 0 where it has fewer than five.
struct Parameters {
  std::array<double, 5> operator()(const NoDistortion&) const { return {}; }
  std::array<double, 5> operator()(const RadialTangential& m) const {
    return {m.k1, m.k2, m.p1, m.p2, m.k3};
  }
  std::array<double, 5> operator()(const KannalaBrandt& m) const {
    return {m.k1, m.k2, m.k3, m.k4, 0.0};
  }
  std::array<double, 5> operator()(const FieldOfView& m) const { return {m.omega}; }
};

void Require(bool holds, const Camera& camera, const std::string& what) {
  if (holds) return;
  throw InputError(camera.source.empty() ? fmt::format("camera: {}", what)
                                         : fmt::format("{}: camera: {}", camera.source, what));
}

bool IsPositive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::optional<Vector2d> Camera::Project(const Vector3d& x_in_cam) const {
  if (!(x_in_cam.z() > 0.0)) return std::nullopt;
  const auto distorted = Distort(distortion, x_in_cam.head<2>() / x_in_cam.z());
  if (!distorted) return std::nullopt;
  const Vector2d pixel = pinhole.Project(distorted->homogeneous());
  if (!pixel.allFinite()) return std::nullopt;
  return pixel;
}

std::optional<Vector3d> Camera::Unproject(const Vector2d& pixel) const {
  const auto ideal =
      RemoveDistortion(distortion, ValidLimit(distortion), pinhole.Unproject(pixel).head<2>());
  if (!ideal) return std::nullopt;
  return ideal->homogeneous().normalized();
}

std::optional<Vector2d> Camera::Undistort(const Vector2d& pixel) const {
  return UndistortionMap(*this).Undistort(pixel);
}

bool Camera::HasDistortion() const {
  for (const double parameter : std::visit(Parameters{}, distortion)) {
    if (parameter != 0.0) return true;
  }
  // An exact KannalaBrandt{} is the equidistant fisheye: its zero parameters still distort.
  return std::holds_alternative<KannalaBrandt>(distortion);
}

std::string Camera::ModelName() const {
  constexpr std::array<const char*, 4> kNames = {"pinhole", "radial_tangential", "kannala_brandt",
                                                 "fov"};
  static_assert(std::variant_size_v<Distortion> == kNames.size());
  return kNames[distortion.index()];
}

void Camera::Check() const {
  const PinholeIntrinsics& p = pinhole;
  Require(p.width > 0 && p.height > 0, *this,
          fmt::format("image size is {} x {}, expected positive numbers", p.width, p.height));
  Require(IsPositive(p.fx) && IsPositive(p.fy), *this,
          fmt::format("focal length is {}, {}, expected positive numbers of pixels", p.fx, p.fy));
  const bool is_inside =
      p.cx > -0.5 && p.cx < p.width - 0.5 && p.cy > -0.5 && p.cy < p.height - 0.5;
  Require(is_inside, *this,
          fmt::format("principal point {}, {} lies outside the image of {} x {} pixels", p.cx, p.cy,
                      p.width, p.height));
  for (const double parameter : std::visit(Parameters{}, distortion)) {
    Require(
        std::isfinite(parameter), *this,
        fmt::format("a {} distortion parameter is {}, expected a number", ModelName(), parameter));
  }
  if (const auto* fov = std::get_if<FieldOfView>(&distortion)) {
    Require(fov->omega >= 0.0 && fov->omega < std::numbers::pi, *this,
            fmt::format("fov omega is {}, expected radians from 0 to below pi", fov->omega));
  }
}

}  // namespace lift_slam
