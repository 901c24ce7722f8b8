#include "lift_slam/simulation/rendering/daylight.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

Daylight At(double elevation_deg) {
  RenderQuality quality;
  quality.own_sun = true;
  quality.sun_elevation_deg = elevation_deg;
  quality.sun_azimuth_deg = 90.0;
  return MakeDaylight(Scene{}, quality);
}

TEST(Daylight, IsTheScenesOwnUnlessAsked) {
  const Daylight light = MakeDaylight(Scene{}, RenderQuality{});
  EXPECT_EQ(light.to_sun, SceneLight{}.to_sun);
  EXPECT_EQ(light.diffuse, SceneLight{}.diffuse);
  EXPECT_EQ(light.sky_tint, Eigen::Vector3f::Ones());
  EXPECT_EQ(light.fog_density, 0.0F);
}

TEST(Daylight, SunStandsWhereTheAnglesSay) {
  EXPECT_TRUE(At(30.0).to_sun.isApprox(Eigen::Vector3f(0.0F, std::sqrt(0.75F), 0.5F), 1e-5F));
}

TEST(Daylight, LowSunIsWeakerAndRedder) {
  EXPECT_TRUE(At(90.0).diffuse.isApprox(SceneLight{}.diffuse, 0.01F));
  double red_over_blue = 0.99;
  double brightness = 10.0;
  for (const double elevation : {90.0, 45.0, 20.0, 8.0, 2.0}) {
    const Daylight light = At(elevation);
    EXPECT_LT(light.diffuse.y(), brightness) << elevation;
    EXPECT_GT(light.diffuse.x() / light.diffuse.z(), red_over_blue) << elevation;
    brightness = light.diffuse.y();
    red_over_blue = light.diffuse.x() / light.diffuse.z();
  }
}

TEST(Daylight, NightHasNoSunAndADarkSky) {
  EXPECT_EQ(At(-5.0).diffuse, Eigen::Vector3f::Zero());
  EXPECT_LT(At(-12.0).sky_tint.maxCoeff(), 0.06F);
  EXPECT_GT(At(60.0).sky_tint.minCoeff(), 0.99F);
}

}  // namespace
}  // namespace lift_slam
