#include "lift_slam/optimization/so3.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

TEST(So3, ExpIsRotationAboutItsAxis) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
  for (const double angle : {0.0, 1e-9, 0.9e-4, 1.1e-4, 0.5, 3.0}) {
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(angle, axis));
    EXPECT_LT((ExpSo3(angle * axis).coeffs() - expected.coeffs()).norm(), 1e-15) << angle;
  }
}

TEST(So3, LeftJacobianMatchesDifferences) {
  const Eigen::Vector3d axis = Eigen::Vector3d(3, 1, -2).normalized();
  for (const double angle : {0.0, 1e-5, 0.9e-3, 1.1e-3, 0.7, 2.5}) {
    const Eigen::Vector3d w = angle * axis;
    const Eigen::Matrix3d jacobian = LeftJacobianSo3(w);
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-6;
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
      const Eigen::Quaterniond change = ExpSo3(w + step) * ExpSo3(w - step).conjugate();
      EXPECT_LT((change.vec() / kStep - jacobian.col(k)).norm(), 1e-9) << angle;
    }
  }
}

}  // namespace
}  // namespace lift_slam
