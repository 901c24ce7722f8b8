#include "lift_slam/optimization/cost_functions/pose_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lift_slam/optimization/test_scene.h"

namespace lift_slam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class PoseCostTest : public testing::Test {
 protected:
  // 11 observations, so that the last group of lanes is padded.
  void Make(double sigma_px) {
    Random random(5);
    scene_ = MakePoseScene({.num_points = 11, .sigma_px = sigma_px}, random);
    for (std::size_t i = 0; i < scene_.observations.size(); ++i) {
      scene_.observations[i].inverse_variance = 1.0 / (1.0 + static_cast<double>(i));
      arrays_.Add(scene_.observations[i]);
    }
    arrays_.Pad();
  }

  // The cost by its definition, one observation at a time.
  double ExpectedSquaredNorm(const Rigid3d& cam_from_world, double width) const {
    double sum = 0.0;
    for (const auto& o : scene_.observations) {
      const Eigen::Vector2d projected =
          scene_.intrinsics.Project(cam_from_world * o.point_in_world);
      const double e = o.inverse_variance * (projected - o.pixel).squaredNorm();
      sum += e <= width * width ? e : 2.0 * width * std::sqrt(e) - width * width;
    }
    return sum;
  }

  // Away from the base pose.
  void ExpectGradientOfDifferences(const PoseCost& cost) const {
    const Vector6d gradient = cost.Evaluate(parameters_).gradient;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = 1e-6 * Vector6d::Unit(k);
      const double difference =
          (cost.SquaredNorm(parameters_ + step) - cost.SquaredNorm(parameters_ - step)) / 2e-6;
      EXPECT_NEAR(gradient[k], 0.5 * difference, 1e-6 * gradient.norm());
    }
  }

  PoseScene scene_;
  PoseObservationArrays arrays_;
  const Vector6d parameters_ = (Vector6d() << 0.02, -0.3, 0.04, 0.3, 0.1, -0.2).finished();
};

TEST_F(PoseCostTest, SquaredNormIsThatOfTheDefinition) {
  Make(3.0);
  for (const double width : {2.0, 20.0, kInfinity}) {
    const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, width, arrays_);
    for (const Vector6d& parameters : {Vector6d(Vector6d::Zero()), parameters_}) {
      const double expected = ExpectedSquaredNorm(cost.CamFromWorld(parameters), width);
      EXPECT_NEAR(cost.SquaredNorm(parameters), expected, 1e-9 * expected);
      EXPECT_NEAR(cost.Evaluate(parameters).squared_norm, expected, 1e-9 * expected);
    }
  }
}

TEST_F(PoseCostTest, GradientMatchesDifferencesAwayFromTheBasePose) {
  Make(3.0);
  for (const double width : {3.0, kInfinity}) {
    const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, width, arrays_);
    ExpectGradientOfDifferences(cost);
  }
}

TEST_F(PoseCostTest, PriorAddsTheWeightedSquaredDistanceOfTheCenters) {
  Make(3.0);
  const CenterPrior prior{scene_.cam_from_world.TargetOriginInSource() + Eigen::Vector3d(1, 2, 3),
                          0.5};
  const PoseCost without(scene_.intrinsics, scene_.cam_from_world, 3.0, arrays_);
  const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, 3.0, arrays_, prior);
  EXPECT_NEAR(cost.SquaredNorm(Vector6d::Zero()) - without.SquaredNorm(Vector6d::Zero()),
              0.5 * 14.0, 1e-9);
  EXPECT_NEAR(cost.SquaredNorm(parameters_), cost.Evaluate(parameters_).squared_norm, 1e-9);
  ExpectGradientOfDifferences(cost);
}

TEST_F(PoseCostTest, HessianIsThatOfTheGradientAtAPerfectFit) {
  Make(0.0);  // without residuals J^T J is the whole second derivative
  for (const double of_prior : {0.0, 1e4}) {
    const CenterPrior prior{scene_.cam_from_world.TargetOriginInSource(), of_prior};
    const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, kInfinity, arrays_, prior);
    const Eigen::Matrix<double, 6, 6> hessian = cost.Evaluate(Vector6d::Zero()).hessian;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = 1e-6 * Vector6d::Unit(k);
      const Vector6d difference =
          (cost.Evaluate(step).gradient - cost.Evaluate(-step).gradient) / 2e-6;
      EXPECT_LT((hessian.col(k) - difference).norm(), 1e-6 * hessian.norm());
    }
  }
}

TEST_F(PoseCostTest, CompressedFormHasTheSameNormalEquations) {
  Make(3.0);
  const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, 3.0, arrays_);
  const NormalEquations<6> expected = cost.Evaluate(parameters_);
  Eigen::Matrix<double, 7, 1> residuals, residuals_alone;
  Eigen::Matrix<double, 7, 6> jacobian;
  ASSERT_TRUE(cost(parameters_.data(), residuals.data(), jacobian.data()));
  ASSERT_TRUE(cost(parameters_.data(), residuals_alone.data(), nullptr));
  EXPECT_LT((jacobian.transpose() * jacobian - expected.hessian).norm(),
            1e-9 * expected.hessian.norm());
  EXPECT_LT((jacobian.transpose() * residuals - expected.gradient).norm(),
            1e-9 * expected.gradient.norm());
  EXPECT_NEAR(residuals.squaredNorm(), expected.squared_norm, 1e-9 * expected.squared_norm);
  EXPECT_NEAR(residuals_alone.squaredNorm(), expected.squared_norm, 1e-9 * expected.squared_norm);
}

TEST_F(PoseCostTest, PointBehindTheCameraCostsInfinitelyMuch) {
  Make(0.0);
  const PoseCost cost(scene_.intrinsics, scene_.cam_from_world, kInfinity, arrays_);
  const Vector6d backward = -70.0 * Vector6d::Unit(5);
  EXPECT_EQ(cost.SquaredNorm(backward), kInfinity);
  EXPECT_EQ(cost.Evaluate(backward).squared_norm, kInfinity);
}

TEST(WriteCompressed, FreeDirectionsGetZeroRows) {
  NormalEquations<6> equations;  // of one residual 2 = 0 with the Jacobian (3, 0, 0, 4, 0, 0)
  const Vector6d row = (Vector6d() << 3, 0, 0, 4, 0, 0).finished();
  equations.hessian = row * row.transpose();
  equations.gradient = 2.0 * row;
  equations.squared_norm = 4.0;
  Eigen::Matrix<double, 7, 1> residuals;
  Eigen::Matrix<double, 7, 6> jacobian;
  WriteCompressed<6>(equations, residuals.data(), jacobian.data());
  EXPECT_TRUE(residuals.allFinite());
  EXPECT_LT((jacobian.transpose() * jacobian - equations.hessian).norm(), 1e-12);
  EXPECT_LT((jacobian.transpose() * residuals - equations.gradient).norm(), 1e-12);
  EXPECT_NEAR(residuals.squaredNorm(), 4.0, 1e-12);
}

}  // namespace
}  // namespace lift_slam
