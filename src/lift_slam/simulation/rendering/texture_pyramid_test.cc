#include "lift_slam/simulation/rendering/texture_pyramid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/rendering/scene_for_test.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

TEST(TexturePyramid, HalvesDownToOneTexel) {
  const auto levels =
      MakeTexturePyramid(CheckerTexture({0, 0, 0, 255}, {200, 200, 200, 255}, 5, 3, 1));
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[1].width, 2);
  EXPECT_EQ(levels[1].height, 1);
  EXPECT_EQ(levels[2].width, 1);
  EXPECT_EQ(levels[2].height, 1);
}

TEST(TexturePyramid, AveragesColors) {
  const auto levels =
      MakeTexturePyramid(CheckerTexture({0, 40, 0, 255}, {200, 60, 10, 255}, 4, 4, 1));
  for (std::size_t i = 0; i < levels[1].rgba.size(); i += 4) {
    EXPECT_EQ(levels[1].rgba[i], 100);
    EXPECT_EQ(levels[1].rgba[i + 1], 50);
    EXPECT_EQ(levels[1].rgba[i + 2], 5);
    EXPECT_EQ(levels[1].rgba[i + 3], 255);
  }
}

TEST(TexturePyramid, TreesKeepTheirLeavesInTheDistance) {
  const Scene scene = Street(1, 3);
  const auto levels = MakeTexturePyramid(scene.textures.back());
  const double coverage = AlphaCoverage(levels[0]);
  ASSERT_GT(coverage, 0.1);
  ASSERT_LT(coverage, 0.9);
  for (std::size_t i = 1; i + 3 < levels.size(); ++i) {
    EXPECT_NEAR(AlphaCoverage(levels[i]), coverage, 0.04) << i;
  }
}

TEST(TexturePyramid, HiddenColorsDoNotShine) {
  // Green where opaque, loud red where not.
  const auto levels = MakeTexturePyramid(CheckerTexture({0, 80, 0, 255}, {255, 0, 0, 0}, 8, 8, 4));
  for (const TextureLevel& level : levels) {
    for (std::size_t i = 0; i < level.rgba.size(); i += 4)
      ASSERT_EQ(level.rgba[i], 0) << level.width;
  }
}

TEST(TexturePyramid, RefusesWrongSizes) {
  EXPECT_THAT(
      [] {
        MakeTexturePyramid({"wall.png", 2, 2, false, std::vector<std::uint8_t>(12)});
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("wall.png")));
  EXPECT_THROW(MakeTexturePyramid({"none", 0, 0, false, {}}), InputError);
}

}  // namespace
}  // namespace lift_slam
