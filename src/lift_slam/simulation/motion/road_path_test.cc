#include "lift_slam/simulation/motion/road_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/motion/test_roads.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

std::string WhyRefused(const Road& road) {
  try {
    RoadPath path(road, 4.0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RoadPath, FollowsACircle) {
  const RoadPath path(CircleRoad(50.0, 60), 4.0);
  EXPECT_NEAR(path.LengthM(), 2.0 * std::numbers::pi * 50.0, 2.0);
  for (double s = 0.0; s < 300.0; s += 17.0) {
    const RoadPlace place = path.At(s);
    EXPECT_NEAR(place.center.norm(), 50.0, 0.3);
    EXPECT_NEAR(place.curvature_per_m, 1.0 / 50.0, 0.002);
    EXPECT_NEAR(place.half_width_m, kTestRoadHalfWidthM, 0.05);
    EXPECT_NEAR(place.left.dot(-place.center.normalized()), 1.0, 1e-3);
    EXPECT_NEAR(place.up.z(), 1.0, 1e-9);
  }
}

TEST(RoadPath, IsMeasuredByTheLengthOfTheWay) {
  const RoadPath path(OvalRoad(), 4.0);
  const double step = 0.01;
  for (double s = 0.0; s < path.LengthM(); s += 3.7) {
    const double way = (path.At(s + step).center - path.At(s).center).norm();
    EXPECT_NEAR(way / step, 1.0, 2e-3) << s;
  }
}

TEST(RoadPath, HasNoSeam) {
  const RoadPath path(OvalRoad(), 4.0);
  const RoadPlace before = path.At(path.LengthM() - 1e-6), after = path.At(1e-6);
  EXPECT_LT((before.center - after.center).norm(), 1e-5);
  EXPECT_LT((before.forward - after.forward).norm(), 1e-5);
  EXPECT_NEAR(before.curvature_per_m, after.curvature_per_m, 1e-5);
}

TEST(RoadPath, FollowsSlopeAndBanking) {
  const RoadPath path(OvalRoad(), 4.0);
  double steepest = 0.0, most_banked = 0.0;
  for (double s = 0.0; s < path.LengthM(); s += 1.0) {
    const RoadPlace place = path.At(s);
    EXPECT_NEAR(place.forward.dot(place.left), 0.0, 1e-9);
    steepest = std::max(steepest, place.forward.z());
    most_banked = std::max(most_banked, -place.left.z());
  }
  EXPECT_NEAR(steepest, 0.19, 0.03);  // 6 m up within a quarter circle of 30 m
  EXPECT_NEAR(most_banked, 0.2, 0.02);
}

TEST(RoadPath, ReversedRoadIsTheSamePlaceDrivenBack) {
  const RoadPath path(OvalRoad(), 4.0), back(Reversed(OvalRoad()), 4.0);
  const RoadPlace there = path.At(100.0), here = back.At(back.LengthM() - 100.0);
  EXPECT_LT((there.center - here.center).norm(), 0.2);
  EXPECT_LT((there.forward + here.forward).norm(), 0.02);
  EXPECT_LT((there.up - here.up).norm(), 0.02);
}

TEST(RoadPath, RefusesWhatIsNoLoop) {
  EXPECT_THAT(WhyRefused(CircleRoad(50.0, 3)), HasSubstr("3 cross-sections"));
  EXPECT_THAT(WhyRefused(CircleRoad(1.0, 10)), HasSubstr("at least 20 m"));
  Road broken = CircleRoad(50.0, 30);
  broken.sections[7].left.x() = std::nan("");
  EXPECT_THAT(WhyRefused(broken), HasSubstr("cross-section 7"));
}

}  // namespace
}  // namespace lift_slam
