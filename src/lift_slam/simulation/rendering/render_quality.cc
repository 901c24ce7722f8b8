#include <string_view>

#include "lift_slam/simulation/rendering/scene_renderer.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
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
  CheckOptionRange("quality.supersampling", supersampling, 1, 8);
  CheckOptionRange("quality.anisotropy", anisotropy, 1, 16);
  CheckOptionRange("quality.near_m", near_m, 1e-3, 1e5);
  CheckOptionRange("quality.far_m", far_m, 1.001 * near_m, 1e7);
  CheckOptionRange("quality.fog_visibility_m", fog_visibility_m, 0.0, 1e7);
  CheckOptionRange("quality.sun_elevation_deg", sun_elevation_deg, -90.0, 90.0);
  CheckOptionRange("quality.sun_azimuth_deg", sun_azimuth_deg, -360.0, 360.0);
}

}  // namespace lift_slam
