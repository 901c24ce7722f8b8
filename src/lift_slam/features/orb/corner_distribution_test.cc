#include "lift_slam/features/orb/corner_distribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr PixelRectangle kArea{19, 19, 1222, 357};

Corner MakeCorner(int x, int y, int score) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
          static_cast<std::uint8_t>(score)};
}

// `count` distinct corners within the rectangle.
std::vector<Corner> RandomCorners(const PixelRectangle& area, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Corner> corners;
  for (int i = 0; i < count; ++i) {
    corners.push_back(MakeCorner(random.UniformInt(area.min_x, area.max_x - 1),
                                 random.UniformInt(area.min_y, area.max_y - 1),
                                 random.UniformInt(8, 200)));
  }
  return corners;
}

TEST(SpreadCorners, GivesTheNumberAskedFor) {
  for (const int count : {1, 2, 5, 100, 434, 999}) {
    EXPECT_EQ(SpreadCorners(kArea, count, RandomCorners(kArea, 5000, 1)).size(),
              static_cast<std::size_t>(count));
  }
}

TEST(SpreadCorners, KeepsAllWhenThereAreFew) {
  EXPECT_EQ(SpreadCorners(kArea, 50, RandomCorners(kArea, 20, 1)).size(), 20U);
  EXPECT_TRUE(SpreadCorners(kArea, 50, {}).empty());
  EXPECT_TRUE(SpreadCorners(kArea, 0, RandomCorners(kArea, 20, 1)).empty());
}

TEST(SpreadCorners, ADenseClusterDoesNotTakeTheShareOfTheRest) {
  std::vector<Corner> corners = RandomCorners({600, 150, 660, 210}, 3000, 2);
  const std::vector<Corner> rest = RandomCorners(kArea, 300, 3);
  corners.insert(corners.end(), rest.begin(), rest.end());
  int outside = 0;
  for (const Corner& c : SpreadCorners(kArea, 400, corners)) {
    outside += c.x < 600 || c.x >= 660 || c.y < 150 || c.y >= 210;
  }
  EXPECT_GT(outside, 200);
}

TEST(SpreadCorners, ALeafGivesItsStrongestCorner) {
  const PixelRectangle area{0, 0, 64, 64};
  std::vector<Corner> corners;
  for (int i = 0; i < 60; ++i) corners.push_back(MakeCorner(i, 63 - i, i == 17 ? 90 : 50));
  const std::vector<Corner> one = SpreadCorners(area, 1, corners);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].x, 17);
}

TEST(SpreadCorners, TallAndTinyAreasWork) {
  const PixelRectangle tall{19, 19, 60, 900}, tiny{19, 19, 20, 20};
  EXPECT_EQ(SpreadCorners(tall, 50, RandomCorners(tall, 500, 4)).size(), 50U);
  EXPECT_EQ(SpreadCorners(tiny, 50, {MakeCorner(19, 19, 30)}).size(), 1U);
}

TEST(DropWeakCorners, ACellWithoutStrongCornersKeepsItsWeakOnes) {
  std::vector<Corner> corners = {MakeCorner(25, 25, 30), MakeCorner(30, 25, 10),
                                 MakeCorner(1100, 300, 10)};
  DropWeakCorners(kArea, 35, 20, corners);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(corners[0].x, 25);
  EXPECT_EQ(corners[1].x, 1100);
}

}  // namespace
}  // namespace lift_slam
