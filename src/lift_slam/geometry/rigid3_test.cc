#include "lift_slam/geometry/rigid3.h"

#include <gtest/gtest.h>

#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

Eigen::Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

Eigen::Quaterniond RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized();
}

TEST(Rigid3d, ComposesAndInverts) {
  Random random(1);
  const Rigid3d b_from_a(RandomRotation(random), RandomVector(random));
  const Rigid3d c_from_b(RandomRotation(random), RandomVector(random));
  const Eigen::Vector3d x = RandomVector(random);
  EXPECT_LT(((c_from_b * b_from_a) * x - c_from_b * (b_from_a * x)).norm(), 1e-12);
  EXPECT_LT((Inverse(b_from_a) * (b_from_a * x) - x).norm(), 1e-12);
  EXPECT_LT((b_from_a * b_from_a.TargetOriginInSource()).norm(), 1e-12);
}

TEST(Rigid3d, RotationAngleIsTheAngle) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  for (const double angle : {1e-9, 0.3, 2.5, 3.14}) {
    EXPECT_NEAR(RotationAngle(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis))), angle, 1e-12);
  }
}

TEST(Sim3d, ComposesAndInverts) {
  Random random(2);
  const Sim3d b_from_a(2.5, RandomRotation(random), RandomVector(random));
  const Sim3d c_from_b(0.3, RandomRotation(random), RandomVector(random));
  const Eigen::Vector3d x = RandomVector(random);
  EXPECT_LT(((c_from_b * b_from_a) * x - c_from_b * (b_from_a * x)).norm(), 1e-12);
  EXPECT_LT((Inverse(b_from_a) * (b_from_a * x) - x).norm(), 1e-12);
}

TEST(Sim3d, TransformedWorldKeepsTheViewingDirectionOfPoints) {
  Random random(3);
  const Sim3d new_from_old(1.7, RandomRotation(random), RandomVector(random));
  const Rigid3d world_from_cam(RandomRotation(random), RandomVector(random));
  const Eigen::Vector3d point = RandomVector(random);
  const Eigen::Vector3d before = Inverse(world_from_cam) * point;
  const Eigen::Vector3d after =
      Inverse(TransformWorld(world_from_cam, new_from_old)) * (new_from_old * point);
  EXPECT_LT((after - 1.7 * before).norm(), 1e-12);
}

}  // namespace
}  // namespace lift_slam
