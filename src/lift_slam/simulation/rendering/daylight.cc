#include "lift_slam/simulation/rendering/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lift_slam {
namespace {

using Eigen::Vector3f;

constexpr double kRadians = std::numbers::pi / 180.0;

Vector3f Direction(double elevation_deg, double azimuth_deg) {
  const double elevation = elevation_deg * kRadians;
  const double azimuth = azimuth_deg * kRadians;
  return Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
      .cast<float>();
}

// Relative length of the way through the air: Kasten and Young, Revised optical air mass tables,
// Applied Optics 28 (1989), eq. (3).
double AirMass(double elevation_deg) {
  const double above = std::max(elevation_deg, 0.0);
  return 1.0 / (std::sin(above * kRadians) + 0.50572 * std::pow(above + 6.07995, -1.6364));
}

// Share of red, green and blue that arrives, 1 for a sun overhead.
Vector3f Transmission(double elevation_deg) {
  const Eigen::Array3d optical_depth(0.08, 0.13, 0.25);  // of a clear sky
  const Eigen::Array3d share = (-optical_depth * (AirMass(elevation_deg) - 1.0)).exp();
  // Half a degree of sun sinks below the horizon; the glow of the haze around it takes longer.
  const double risen = std::clamp((elevation_deg + 1.0) / 2.0, 0.0, 1.0);
  return (share * risen).matrix().cast<float>();
}

// Brightness of the sky: 1 by day, 0.05 at the end of twilight.
Vector3f SkyBrightness(double elevation_deg) {
  const double day = std::clamp((elevation_deg + 12.0) / 32.0, 0.0, 1.0);
  const double level = 0.05 + 0.95 * day * day * (3.0 - 2.0 * day);
  const double red = 0.85 + 0.15 * day;  // twilight is blue
  return Vector3f(static_cast<float>(level * red), static_cast<float>(level * (1.0 + red) / 2.0),
                  static_cast<float>(level));
}

}  // namespace

Daylight MakeDaylight(const Scene& scene, const RenderQuality& quality) {
  const SceneLight& own = scene.light;
  Daylight light{own.to_sun, own.ambient, own.diffuse, Vector3f::Ones(), Vector3f::Zero(), 0.0F};
  if (quality.own_sun) {
    light.to_sun = Direction(quality.sun_elevation_deg, quality.sun_azimuth_deg);
    light.sky_tint = SkyBrightness(quality.sun_elevation_deg);
    light.ambient = own.ambient.cwiseProduct(light.sky_tint);
    light.diffuse = own.diffuse.cwiseProduct(Transmission(quality.sun_elevation_deg));
  }
  // Fog is lit by the sky and half as much coloured.
  const Vector3f grey = Vector3f::Constant(scene.sky.color.mean());
  light.fog_color = (0.5F * (grey + scene.sky.color)).cwiseProduct(light.sky_tint);
  if (quality.fog_visibility_m > 0.0) {
    light.fog_density = static_cast<float>(std::log(20.0) / quality.fog_visibility_m);
  }
  return light;
}

}  // namespace lift_slam
