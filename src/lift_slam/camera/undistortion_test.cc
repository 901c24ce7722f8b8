#include "lift_slam/camera/undistortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lift_slam {
namespace {

using Eigen::Vector2d;

constexpr PinholeIntrinsics kPinhole{458.654, 457.296, 367.215, 248.375, 752, 480};
const RadialTangential kEuroc{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0};

TEST(UndistortionMap, IsTheIdentityWithoutDistortion) {
  const UndistortionMap map(Camera{kPinhole, RadialTangential{}});
  EXPECT_TRUE(map.IsIdentity());
  EXPECT_EQ(*map.Undistort({0.1F, 479.3F}), Vector2d(0.1F, 479.3F));
}

TEST(UndistortionMap, LiesOnTheRayOfThePixel) {
  const Camera camera{kPinhole, kEuroc};
  const UndistortionMap map(camera);
  EXPECT_FALSE(map.IsIdentity());
  for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(751, 479), Vector2d(300.25, 17.5)}) {
    const auto undistorted = map.Undistort(pixel);
    ASSERT_TRUE(undistorted);
    EXPECT_LT((*camera.Project(kPinhole.Unproject(*undistorted)) - pixel).norm(), 1e-9);
    EXPECT_EQ(*camera.Undistort(pixel), *undistorted);
  }
}

TEST(UndistortionMap, RefusesRaysFarOffTheAxis) {
  const PinholeIntrinsics fisheye{190.0, 190.0, 255.5, 255.5, 512, 512};
  const Camera camera{fisheye, KannalaBrandt{}};  // radius 190 * theta
  const double degree = std::numbers::pi / 180.0;
  EXPECT_TRUE(camera.Undistort({255.5 + 190.0 * 84.9 * degree, 255.5}));
  EXPECT_FALSE(camera.Undistort({255.5 + 190.0 * 85.1 * degree, 255.5}));
  EXPECT_TRUE(camera.Unproject({255.5 + 190.0 * 85.1 * degree, 255.5}));
  EXPECT_FALSE(camera.Unproject({255.5 + 190.0 * 91.0 * degree, 255.5}));
}

TEST(UndistortedBounds, WithoutDistortionAreTheImage) {
  const UndistortedBounds bounds = FindUndistortedBounds({kPinhole, NoDistortion{}});
  EXPECT_EQ(bounds.min_x, -0.5);
  EXPECT_EQ(bounds.max_x, 751.5);
  EXPECT_EQ(bounds.min_y, -0.5);
  EXPECT_EQ(bounds.max_y, 479.5);
}

TEST(UndistortedBounds, ContainEveryUndistortedPixel) {
  for (const Distortion& distortion : {Distortion(kEuroc), Distortion(FieldOfView{0.93}),
                                       Distortion(KannalaBrandt{0.003, 0.0007, -0.002, 0.0002})}) {
    const Camera camera{kPinhole, distortion};
    const UndistortedBounds bounds = FindUndistortedBounds(camera);
    EXPECT_LT(bounds.min_x, -20.0);  // barrel distortion: the ideal image is larger
    EXPECT_GT(bounds.max_y, 500.0);
    for (int y = 0; y < 480; y += 7) {
      for (int x = 0; x < 752; x += 7)
        EXPECT_TRUE(bounds.Contains(*camera.Undistort(Vector2d(x, y))));
    }
  }
}

}  // namespace
}  // namespace lift_slam
