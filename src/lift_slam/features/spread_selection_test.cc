#include "lift_slam/features/spread_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::ElementsAre;

constexpr PixelRectangle kArea{0, 0, 100, 40};

TEST(SelectSpread, PointsWithinOnePixelGiveTheStrongest) {
  const std::vector<ScoredPoint> points = {{5.2F, 7.1F, 1.0F},
                                           {5.3F, 7.2F, 3.0F},
                                           {5.4F, 7.3F, 2.0F},
                                           {5.4F, 7.3F, 2.0F},
                                           {80.0F, 30.0F, 0.5F}};
  EXPECT_THAT(SelectSpread(kArea, 4, points), ElementsAre(1, 4));
}

TEST(SelectSpread, PointsOnTheFarBorderAreNotLost) {
  const std::vector<ScoredPoint> points = {
      {100.4F, 39.9F, 1.0F}, {1.0F, 1.0F, 1.0F}, {1.0F, 1.2F, 0.5F}};
  EXPECT_THAT(SelectSpread(kArea, 2, points), ElementsAre(1, 0));
}

TEST(SelectSpread, SparseHalfKeepsItsPoints) {
  Random random(3);
  std::vector<ScoredPoint> points;  // 1000 strong ones on the left, 20 weak ones on the right
  for (int i = 0; i < 1020; ++i) {
    const bool left = i < 1000;
    points.push_back({static_cast<float>(random.Uniform(left ? 0 : 50, left ? 50 : 100)),
                      static_cast<float>(random.Uniform(0, 40)), left ? 10.0F : 1.0F});
  }
  const std::vector<std::size_t> selected = SelectSpread(kArea, 100, points);
  EXPECT_EQ(selected.size(), 100U);
  EXPECT_GE(
      std::count_if(selected.begin(), selected.end(), [](std::size_t i) { return i >= 1000; }), 8);
}

}  // namespace
}  // namespace lift_slam
