#include "lift_slam/optimization/cost_functions/reprojection_cost.h"

#include <gtest/gtest.h>

#include "lift_slam/optimization/test_scene.h"

namespace lift_slam {
namespace {

class ReprojectionCostTest : public testing::Test {
 protected:
  ReprojectionCostTest() : camera_(Rigid3d(ExpSo3({0.3, -0.2, 0.1}), {5.0, -3.0, 2.0})) {
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(camera_.parameters()) << 0.2, -0.1, 0.3, 0.4, 0.5, -0.6;
    camera_.Update();
    point_ = Inverse(camera_.CamFromWorld()) * Eigen::Vector3d(1.0, -0.7, 6.0);
  }

  Eigen::Vector2d Residuals() {
    camera_.Update();
    const double* parameters[] = {point_.data(), camera_.parameters()};
    Eigen::Vector2d residuals;
    EXPECT_TRUE(cost_.Evaluate(parameters, residuals.data(), nullptr));
    return residuals;
  }

  // Central differences by the values of one parameter block.
  Eigen::Matrix2Xd NumericJacobian(double* block, int size) {
    Eigen::Matrix2Xd jacobian(2, size);
    for (int k = 0; k < size; ++k) {
      const double value = block[k];
      block[k] = value + 1e-6;
      const Eigen::Vector2d above = Residuals();
      block[k] = value - 1e-6;
      jacobian.col(k) = (above - Residuals()) / 2e-6;
      block[k] = value;
    }
    camera_.Update();
    return jacobian;
  }

  CameraBlock camera_;
  ReprojectionTerm term_{TestIntrinsics(), {700.0, 120.0}, 0.5};
  ReprojectionCost cost_{term_, camera_};
  FixedCameraReprojectionCost fixed_cost_{term_, camera_};
  Eigen::Vector3d point_;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point_;
  Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_camera_;
  double* jacobians_[2] = {by_point_.data(), by_camera_.data()};
};

TEST_F(ReprojectionCostTest, ResidualIsTheWeightedDifferenceInTheImage) {
  const Eigen::Vector2d pixel = term_.intrinsics.Project(camera_.CamFromWorld() * point_);
  EXPECT_LT((Residuals() - 0.5 * (pixel - term_.pixel)).norm(), 1e-10);
}

TEST_F(ReprojectionCostTest, JacobiansMatchDifferencesAwayFromTheBasePose) {
  const double* parameters[] = {point_.data(), camera_.parameters()};
  Eigen::Vector2d residuals;
  ASSERT_TRUE(cost_.Evaluate(parameters, residuals.data(), jacobians_));
  EXPECT_LT((by_point_ - NumericJacobian(point_.data(), 3)).norm(), 1e-6 * by_point_.norm());
  EXPECT_LT((by_camera_ - NumericJacobian(camera_.parameters(), 6)).norm(),
            1e-6 * by_camera_.norm());
}

TEST_F(ReprojectionCostTest, FixedCameraGivesTheSameResidualsAndPointJacobian) {
  const double* parameters[] = {point_.data(), camera_.parameters()};
  Eigen::Vector2d residuals;
  ASSERT_TRUE(cost_.Evaluate(parameters, residuals.data(), jacobians_));
  Eigen::Vector2d fixed_residuals;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> fixed_by_point;
  double* jacobians[] = {fixed_by_point.data()};
  ASSERT_TRUE(fixed_cost_.Evaluate(parameters, fixed_residuals.data(), jacobians));
  EXPECT_EQ(fixed_residuals, residuals);
  EXPECT_EQ(fixed_by_point, by_point_);
}

TEST_F(ReprojectionCostTest, InactiveTermIsZero) {
  term_.is_active = false;
  const double* parameters[] = {point_.data(), camera_.parameters()};
  Eigen::Vector2d residuals;
  ASSERT_TRUE(cost_.Evaluate(parameters, residuals.data(), jacobians_));
  EXPECT_EQ(residuals.norm() + by_point_.norm() + by_camera_.norm(), 0.0);
}

TEST_F(ReprojectionCostTest, PointBehindTheCameraCostsMuchAndHasNoSlope) {
  point_ = Inverse(camera_.CamFromWorld()) * Eigen::Vector3d(1.0, -0.7, -6.0);
  const double* parameters[] = {point_.data(), camera_.parameters()};
  Eigen::Vector2d residuals;
  ASSERT_TRUE(cost_.Evaluate(parameters, residuals.data(), jacobians_));
  EXPECT_GE(residuals.norm(), 100.0);
  EXPECT_EQ(by_point_.norm() + by_camera_.norm(), 0.0);
}

}  // namespace
}  // namespace lift_slam
