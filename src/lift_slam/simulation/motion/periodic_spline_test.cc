#include "lift_slam/simulation/motion/periodic_spline.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

PeriodicSpline Irregular() {
  return {{{0, 0, 0}, {3, 1, 0}, {4, 5, 1}, {1, 6, -1}, {-2, 3, 2}}, 2.0};
}

TEST(PeriodicSpline, RepeatsAfterItsPeriod) {
  const PeriodicSpline spline = Irregular();
  EXPECT_EQ(spline.Period(), 10.0);
  EXPECT_LT((spline.Value(1.3) - spline.Value(11.3)).norm(), 1e-12);
  EXPECT_LT((spline.Value(-8.7) - spline.Value(1.3)).norm(), 1e-12);
}

TEST(PeriodicSpline, TwiceContinuouslyDifferentiableAtKnotsAndSeam) {
  const PeriodicSpline spline = Irregular();
  for (const double knot : {0.0, 2.0, 4.0, 6.0, 8.0, 10.0}) {
    const double before = knot - 1e-9, after = knot + 1e-9;
    EXPECT_LT((spline.Value(after) - spline.Value(before)).norm(), 1e-7);
    EXPECT_LT((spline.Derivative(after) - spline.Derivative(before)).norm(), 1e-7);
    EXPECT_LT((spline.SecondDerivative(after) - spline.SecondDerivative(before)).norm(), 1e-7);
  }
}

TEST(PeriodicSpline, DerivativesFitDifferences) {
  const PeriodicSpline spline = Irregular();
  for (double x = 0.1; x < 10.0; x += 0.7) {
    const Eigen::Vector3d first = (spline.Value(x + 1e-5) - spline.Value(x - 1e-5)) / 2e-5;
    const Eigen::Vector3d second =
        (spline.Derivative(x + 1e-5) - spline.Derivative(x - 1e-5)) / 2e-5;
    EXPECT_LT((spline.Derivative(x) - first).norm(), 1e-8);
    EXPECT_LT((spline.SecondDerivative(x) - second).norm(), 1e-8);
  }
}

TEST(GaussianKernel, SumsToOneAndKeepsConstants) {
  const std::vector<double> kernel = GaussianKernel(3.0, 1.0);
  EXPECT_EQ(kernel.size(), 19U);
  for (const double value : SmoothAroundLoop(std::vector<double>(40, 7.0), kernel)) {
    EXPECT_NEAR(value, 7.0, 1e-12);
  }
}

TEST(GaussianKernel, OfNoWidthChangesNothing) {
  const std::vector<double> smooth =
      SmoothAroundLoop(std::vector<double>{1, 2, 3, 4, 5}, GaussianKernel(0.0, 1.0));
  EXPECT_NEAR(smooth[2], 3.0, 1e-12);
}

}  // namespace
}  // namespace lift_slam
