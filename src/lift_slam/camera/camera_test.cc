#include "lift_slam/camera/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "lift_slam/camera/distortion.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr PinholeIntrinsics kEuroc{458.654, 457.296, 367.215, 248.375, 752, 480};

struct Case {
  std::string name;
  Camera camera;
};

std::vector<Case> AllModels() {
  const auto with = [](std::string name, const PinholeIntrinsics& pinhole, Distortion distortion) {
    return Case{std::move(name), Camera{pinhole, std::move(distortion), 20.0, "test"}};
  };
  const PinholeIntrinsics tum_mono{364.0, 536.0, 640.0, 510.0, 1280, 1024};
  const PinholeIntrinsics fisheye{190.97, 190.97, 254.93, 256.89, 512, 512};
  const PinholeIntrinsics tum_rgbd{517.3, 516.5, 318.6, 255.3, 640, 480};
  const PinholeIntrinsics strong{300.0, 300.0, 320.0, 240.0, 640, 480};
  return {
      with("Pinhole", kEuroc, NoDistortion{}),
      with("RadialTangentialEuroc", kEuroc,
           RadialTangential{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}),
      with("RadialTangentialFreiburg1", tum_rgbd,
           RadialTangential{0.262383, -0.953104, -0.005358, 0.002628, 1.163314}),
      with("RadialTangentialStrong", strong, RadialTangential{-0.4, 0.1, 0.01, -0.02, 0.05}),
      with("RadialTangentialZero", kEuroc, RadialTangential{}),
      with("KannalaBrandtTumVi", fisheye, KannalaBrandt{0.0034, 0.0007, -0.0020, 0.0002}),
      with("KannalaBrandtEquidistant", fisheye, KannalaBrandt{}),
      with("FieldOfViewTumMono", tum_mono, FieldOfView{0.93}),
      with("FieldOfViewZero", kEuroc, FieldOfView{0.0}),
  };
}

class EveryModel : public testing::TestWithParam<Case> {
 protected:
  const Camera& camera() const { return GetParam().camera; }
};

TEST_P(EveryModel, UnprojectInvertsProject) {
  Random random(1);
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d ray =
        Vector3d(random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), 1.0).normalized();
    const auto pixel = camera().Project(ray * random.Uniform(0.1, 50.0));
    if (!pixel) continue;
    ++valid;
    const auto back = camera().Unproject(*pixel);
    ASSERT_TRUE(back) << ray.transpose();
    EXPECT_NEAR(back->norm(), 1.0, 1e-12);
    // Where the distortion nearly stops rising its inverse is ill-conditioned: 1e-9 for pixels,
    // less for rays.
    EXPECT_LT((*back - ray).norm(), 1e-6);
    EXPECT_LT((*camera().Project(*back) - *pixel).norm(), 1e-9);
  }
  EXPECT_GT(valid, 200);
}

TEST_P(EveryModel, ProjectInvertsUnprojectAllOverTheImage) {
  int valid = 0;
  for (int y = 0; y < camera().pinhole.height; y += 16) {
    for (int x = 0; x < camera().pinhole.width; x += 16) {
      const Vector2d pixel(x, y);
      const auto ray = camera().Unproject(pixel);
      if (!ray) continue;
      ++valid;
      const auto back = camera().Project(*ray);
      ASSERT_TRUE(back) << pixel.transpose();
      EXPECT_LT((*back - pixel).norm(), 1e-9) << pixel.transpose();
    }
  }
  const int tried = (camera().pinhole.width / 16) * (camera().pinhole.height / 16);
  EXPECT_GT(valid, tried / 2);
}

TEST_P(EveryModel, AgreesWithOpenCv) {
  const Distortion& distortion = camera().distortion;
  if (std::holds_alternative<FieldOfView>(distortion)) return;  // not in OpenCV
  const PinholeIntrinsics& p = camera().pinhole;
  const cv::Matx33d matrix(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Vector3d x(random.Uniform(-0.8, 0.8), random.Uniform(-0.8, 0.8),
                     random.Uniform(0.8, 2.0));
    const auto pixel = camera().Project(x);
    if (!pixel) continue;
    const std::vector<cv::Point3d> points = {{x.x(), x.y(), x.z()}};
    std::vector<cv::Point2d> expected;
    const cv::Vec3d zero(0, 0, 0);
    if (const auto* kb = std::get_if<KannalaBrandt>(&distortion)) {
      cv::fisheye::projectPoints(points, expected, zero, zero, matrix,
                                 cv::Vec4d(kb->k1, kb->k2, kb->k3, kb->k4));
    } else {
      const auto* rt = std::get_if<RadialTangential>(&distortion);
      const RadialTangential m = rt != nullptr ? *rt : RadialTangential{};
      cv::projectPoints(points, zero, zero, matrix,
                        cv::Vec<double, 5>(m.k1, m.k2, m.p1, m.p2, m.k3), expected);
    }
    EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
  }
}

TEST_P(EveryModel, NothingIsEverNotANumber) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double z : {-1.0, 0.0, 1e-300, 1e-3, 1.0, kNaN}) {
    for (const double x : {0.0, 1e-20, 1.0, 1e8, 1e300, kInfinity, kNaN}) {
      const auto pixel = camera().Project({x, -x, z});
      EXPECT_TRUE(!pixel || pixel->allFinite()) << x << " " << z;
    }
  }
  for (const double u : {-1e300, -1e5, -50.0, 0.0, 700.0, 2000.0, 1e8, kInfinity, kNaN}) {
    const auto ray = camera().Unproject({u, 240.0});
    EXPECT_TRUE(!ray || ray->allFinite()) << u;
    const auto undistorted = camera().Undistort({u, 240.0});
    EXPECT_TRUE(!undistorted || undistorted->allFinite()) << u;
  }
  EXPECT_FALSE(camera().Project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(camera().Project({0.1, 0.1, 0.0}));
}

INSTANTIATE_TEST_SUITE_P(Camera, EveryModel, testing::ValuesIn(AllModels()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(Camera, RadialDistortionIsRefusedWhereItFoldsBack) {
  // r (1 - 0.3 r^2) rises up to r = sqrt(1 / 0.9).
  const Camera camera{kEuroc, RadialTangential{.k1 = -0.3}};
  const double limit = std::sqrt(1.0 / 0.9);
  EXPECT_NEAR(ValidLimit(camera.distortion), limit, 1e-9);
  EXPECT_TRUE(camera.Project({limit - 1e-6, 0.0, 1.0}));
  EXPECT_FALSE(camera.Project({limit + 1e-6, 0.0, 1.0}));
  const double largest_x = kEuroc.fx * limit * (1.0 - 0.3 * limit * limit) + kEuroc.cx;
  EXPECT_TRUE(camera.Unproject({largest_x - 1e-3, kEuroc.cy}));
  EXPECT_FALSE(camera.Unproject({largest_x + 1e-3, kEuroc.cy}));
}

TEST(Camera, FieldOfViewFollowsItsFormula) {
  const Camera camera{kEuroc, FieldOfView{0.93}};
  const double distorted = std::atan(2.0 * 0.5 * std::tan(0.465)) / 0.93;
  const auto pixel = camera.Project({0.3, 0.4, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), kEuroc.fx * distorted * 0.6 + kEuroc.cx, 1e-12);
  EXPECT_NEAR(pixel->y(), kEuroc.fy * distorted * 0.8 + kEuroc.cy, 1e-12);
}

TEST(Camera, KnowsItsModelAndWhetherItDistorts) {
  EXPECT_EQ((Camera{kEuroc, NoDistortion{}}.ModelName()), "pinhole");
  EXPECT_EQ((Camera{kEuroc, RadialTangential{}}.ModelName()), "radial_tangential");
  EXPECT_EQ((Camera{kEuroc, KannalaBrandt{}}.ModelName()), "kannala_brandt");
  EXPECT_EQ((Camera{kEuroc, FieldOfView{}}.ModelName()), "fov");
  EXPECT_FALSE((Camera{kEuroc, NoDistortion{}}.HasDistortion()));
  EXPECT_FALSE((Camera{kEuroc, RadialTangential{}}.HasDistortion()));
  EXPECT_FALSE((Camera{kEuroc, FieldOfView{}}.HasDistortion()));
  EXPECT_TRUE((Camera{kEuroc, RadialTangential{.p2 = 1e-3}}.HasDistortion()));
  EXPECT_TRUE((Camera{kEuroc, KannalaBrandt{}}.HasDistortion()));
  EXPECT_TRUE((Camera{kEuroc, FieldOfView{0.9}}.HasDistortion()));
}

std::string CheckMessage(const PinholeIntrinsics& pinhole, const Distortion& distortion = {}) {
  try {
    Camera{pinhole, distortion, 0.0, "cam.yaml"}.Check();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Camera, CheckNamesFileAndFault) {
  using testing::AllOf;
  using testing::HasSubstr;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CheckMessage(kEuroc), "");
  EXPECT_THAT(CheckMessage({0.0, 1.0, 1.0, 1.0, 9, 9}),
              AllOf(HasSubstr("cam.yaml"), HasSubstr("focal")));
  EXPECT_THAT(CheckMessage({1.0, kNaN, 1.0, 1.0, 9, 9}), HasSubstr("focal length"));
  EXPECT_THAT(CheckMessage({1.0, 1.0, 1.0, 1.0, 0, 9}), HasSubstr("image size"));
  EXPECT_THAT(CheckMessage({1.0, 1.0, 9.0, 1.0, 9, 9}), HasSubstr("principal point"));
  EXPECT_THAT(CheckMessage({1.0, 1.0, 1.0, kNaN, 9, 9}), HasSubstr("principal point"));
  EXPECT_THAT(CheckMessage(kEuroc, RadialTangential{.k3 = kNaN}), HasSubstr("distortion"));
  EXPECT_THAT(CheckMessage(kEuroc, FieldOfView{4.0}), HasSubstr("omega"));
}

}  // namespace
}  // namespace lift_slam
