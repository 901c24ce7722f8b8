#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "lift_slam/simulation/rendering/scene_renderer.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

void RequireRange(std::string_view name, double value, double lowest, double highest) {
  if (std::isfinite(value) && value >= lowest && value <= highest) return;
  throw InputError(
      fmt::format("{} is {}, expected a number from {} to {}", name, value, lowest, highest));
}

}  // namespace

void RenderQuality::Visit(OptionVisitor& visitor) {
  visitor.Field("supersampling", supersampling, "samples a pixel and direction, 1 to 8");
  visitor.Field("anisotropy", anisotropy, "of the texture filter, 1 to 16");
  visitor.Field("near_m", near_m, "nothing nearer is seen");
  visitor.Field("far_m", far_m, "nothing farther is seen");
  visitor.Field("fog_visibility_m", fog_visibility_m,
                "distance at which 5 % of the contrast is left; 0: no fog");
  visitor.Field("own_sun", own_sun, "sun and light of the two angles below; false: the scene's");
  visitor.Field("sun_elevation_deg", sun_elevation_deg, "above the horizon, -90 to 90");
  visitor.Field("sun_azimuth_deg", sun_azimuth_deg, "from the scene's x towards its y");
}

void RenderQuality::Check() const {
  RequireRange("supersampling", supersampling, 1, 8);
  RequireRange("anisotropy", anisotropy, 1, 16);
  RequireRange("near_m", near_m, 1e-3, 1e5);
  RequireRange("far_m", far_m, 1.001 * near_m, 1e7);
  RequireRange("fog_visibility_m", fog_visibility_m, 0.0, 1e7);
  RequireRange("sun_elevation_deg", sun_elevation_deg, -90.0, 90.0);
  RequireRange("sun_azimuth_deg", sun_azimuth_deg, -360.0, 360.0);
}

}  // namespace lift_slam
