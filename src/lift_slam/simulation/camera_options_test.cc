#include "lift_slam/simulation/camera_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

TEST(CameraOptions, DefaultIsUsable) {
  const CameraOptions options;
  EXPECT_NO_THROW(options.Check());
  EXPECT_EQ(options.ToCamera().pinhole.width, 1241);
  EXPECT_FALSE(options.ToCamera().HasDistortion());
}

TEST(CameraOptions, TakeEveryModelAndGiveItBack) {
  for (const Distortion& distortion :
       {Distortion(RadialTangential{0.1, -0.02, 0.001, 0.002, 0.003}),
        Distortion(KannalaBrandt{0.1, 0.01, -0.002, 0.001}), Distortion(FieldOfView{0.9})}) {
    Camera camera;
    camera.pinhole = {300, 310, 319, 239, 640, 480};
    camera.distortion = distortion;
    CameraOptions options;
    options.Set(camera);
    const Eigen::Vector3d point(0.2, 0.1, 1.0);
    EXPECT_EQ(options.ToCamera().ModelName(), camera.ModelName());
    EXPECT_EQ(*options.ToCamera().Project(point), *camera.Project(point));
    EXPECT_EQ(options.rate_hz, 10.0);  // the calibration has none
  }
}

TEST(CameraOptions, ScalingKeepsTheViewAcrossAndThePixelsShape) {
  CameraOptions options;
  const Camera before = options.ToCamera();
  options.ScaleTo(620, 300);
  const Camera after = options.ToCamera();
  EXPECT_EQ(after.pinhole.fx, after.pinhole.fy);
  // The image's edges are half a pixel outside the outermost pixel centres.
  EXPECT_NEAR(before.pinhole.Unproject({-0.5, 0}).x(), after.pinhole.Unproject({-0.5, 0}).x(),
              1e-12);
  EXPECT_NEAR(before.pinhole.Unproject({1240.5, 0}).x(), after.pinhole.Unproject({619.5, 0}).x(),
              1e-12);
  EXPECT_NEAR(before.pinhole.Unproject({0, 187.5}).y(), after.pinhole.Unproject({0, 149.5}).y(),
              1e-12);
}

TEST(CameraOptions, RefuseSizesAndRatesThatCannotBe) {
  const auto why = [](const CameraOptions& options) -> std::string {
    try {
      options.Check();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CameraOptions options;
  options.width = 0;
  EXPECT_THAT(why(options), HasSubstr("0x376"));
  options = {};
  options.rate_hz = 0.0;
  EXPECT_THAT(why(options), HasSubstr("rate_hz"));
  options = {};
  options.fx = -1.0;
  EXPECT_THAT(why(options), ::testing::Not(::testing::IsEmpty()));
  EXPECT_THROW(options.ScaleTo(0, 10), InputError);
}

}  // namespace
}  // namespace lift_slam
