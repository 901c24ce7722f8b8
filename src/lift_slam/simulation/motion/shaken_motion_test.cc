#include "lift_slam/simulation/motion/shaken_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

class Still : public CameraMotion {
 public:
  Rigid3d WorldFromCam(double) const override {
    return {Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  }
  double DurationS() const override { return 100.0; }
};

ShakeOptions Trembling() {
  ShakeOptions options;
  options.translation_m = 0.01;
  options.rotation_deg = 1.0;
  return options;
}

TEST(ShakenMotion, TremblesAsStronglyAsAsked) {
  const ShakenMotion motion(std::make_shared<Still>(), Trembling(), 1);
  double translation = 0.0, rotation = 0.0;
  const int count = 5000;
  for (int i = 0; i < count; ++i) {
    const Rigid3d pose = motion.WorldFromCam(i * 0.0193);
    translation += (pose.translation - Eigen::Vector3d(1.0, 2.0, 3.0)).squaredNorm();
    rotation += std::pow(RotationAngle(pose.rotation) * 180.0 / std::numbers::pi, 2);
  }
  EXPECT_NEAR(std::sqrt(translation / count), 0.01 * std::sqrt(3.0), 0.001);
  EXPECT_NEAR(std::sqrt(rotation / count), std::sqrt(3.0), 0.1);
}

TEST(ShakenMotion, IsSmooth) {
  const ShakenMotion motion(std::make_shared<Still>(), Trembling(), 2);
  for (double t = 0.0; t < 20.0; t += 0.01) {
    const Eigen::Vector3d moved =
        motion.WorldFromCam(t + 1e-3).translation - motion.WorldFromCam(t).translation;
    EXPECT_LT(moved.norm() / 1e-3, 2.0 * std::numbers::pi * 8.0 * 0.06);
  }
}

TEST(ShakenMotion, SameSeedSameShake) {
  const ShakenMotion a(std::make_shared<Still>(), Trembling(), 3),
      b(std::make_shared<Still>(), Trembling(), 3), c(std::make_shared<Still>(), Trembling(), 4);
  EXPECT_EQ(a.WorldFromCam(5.0).translation, b.WorldFromCam(5.0).translation);
  EXPECT_NE(a.WorldFromCam(5.0).translation, c.WorldFromCam(5.0).translation);
}

TEST(ShakenMotion, OffChangesNothing) {
  EXPECT_TRUE(ShakeOptions().IsOff());
  const ShakenMotion motion(std::make_shared<Still>(), ShakeOptions(), 1);
  EXPECT_EQ(motion.WorldFromCam(5.0).translation, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(ShakenMotion, RefusesAnImpossibleBand) {
  ShakeOptions options = Trembling();
  options.high_hz = 0.1;
  EXPECT_THROW(ShakenMotion(std::make_shared<Still>(), options, 1), InputError);
}

}  // namespace
}  // namespace lift_slam
