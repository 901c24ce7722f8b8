#include "lift_slam/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

const Eigen::Quaterniond kTurn(Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.2, 1.0, 0.1).normalized()));

Eigen::Vector2d Normalized(const Rigid3d& cam_from_world, const Eigen::Vector3d& point) {
  return (cam_from_world * point).hnormalized();
}

TEST(Triangulation, RecoversExactPointFromTwoViews) {
  const Rigid3d cam2_from_cam1(kTurn, {-0.3, 0.05, 0.1});
  const Eigen::Vector3d point(0.5, -0.4, 6.0);
  const auto found = TriangulatePoint(cam2_from_cam1, Normalized(Rigid3d(), point),
                                      Normalized(cam2_from_cam1, point));
  ASSERT_TRUE(found);
  EXPECT_LT((*found - point).norm(), 1e-9);
}

TEST(Triangulation, DoesNotCareWhereTheWorldOriginIs) {
  const Eigen::Vector3d offset(4000.0, -30.0, 9000.0);
  const Eigen::Vector3d point = offset + Eigen::Vector3d(0.5, -0.4, 12.0);
  std::vector<PointView> views;
  for (const double x : {0.0, 0.4, 0.8}) {
    const Rigid3d cam_from_world = Inverse(Rigid3d(kTurn, offset + Eigen::Vector3d(x, 0, 0)));
    views.push_back({cam_from_world, Normalized(cam_from_world, point)});
  }
  const auto found = TriangulatePoint(views);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - point).norm(), 1e-6);
}

TEST(Triangulation, MoreViewsMeanLessError) {
  Random random(3);
  const Eigen::Vector3d point(0.5, -0.4, 8.0);
  double two_views = 0.0, ten_views = 0.0;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<PointView> views;
    for (int i = 0; i < 10; ++i) {
      const Rigid3d cam_from_world(kTurn, {0.1 * (i % 2), 0.01 * i, 0.0});
      const Eigen::Vector2d noise(random.Normal(), random.Normal());
      views.push_back({cam_from_world, Normalized(cam_from_world, point) + 1e-4 * noise});
    }
    two_views += (*TriangulatePoint(std::span(views).first(2)) - point).norm();
    ten_views += (*TriangulatePoint(views) - point).norm();
  }
  EXPECT_LT(ten_views, 0.6 * two_views);
}

TEST(Triangulation, ReturnsNothingWithoutBaseline) {
  EXPECT_FALSE(TriangulatePoint(Rigid3d(), {0.1, 0.2}, {0.1, 0.2}));
}

TEST(Triangulation, ReturnsNothingForParallelRays) {
  const Rigid3d shifted(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0});
  EXPECT_FALSE(TriangulatePoint(shifted, {0.1, 0.2}, {0.1, 0.2}));
}

TEST(Triangulation, SmallAnglesAreExact) {
  const Eigen::Vector3d a(0.0, 0.0, 3.0);
  EXPECT_NEAR(AngleBetween(a, {1e-9, 0.0, 1.0}), 1e-9, 1e-15);
  EXPECT_NEAR(AngleBetween(a, -a), std::numbers::pi, 1e-12);
  EXPECT_NEAR(ParallaxAngle({-1, 0, 0}, {1, 0, 0}, {0, 0, 1}), std::numbers::pi / 2, 1e-12);
}

TEST(Triangulation, ReprojectionErrorIsInfiniteBehindTheCamera) {
  const double error = SquaredReprojectionError(Rigid3d(), {0.2, 0.0, 2.0}, {0.13, 0.04});
  EXPECT_NEAR(error, 0.03 * 0.03 + 0.04 * 0.04, 1e-12);
  EXPECT_TRUE(std::isinf(SquaredReprojectionError(Rigid3d(), {0.2, 0.0, -2.0}, {-0.1, 0.0})));
}

}  // namespace
}  // namespace lift_slam
