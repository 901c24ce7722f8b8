#include "lift_slam/simulation/scene/sgi_image.h"

#include <gmock/gmock.h>

#include "lift_slam/simulation/scene/scene_test_files.h"

namespace lift_slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SgiImage, VerbatimGreyIsFlippedToTopFirst) {
  const SceneTexture texture = DecodeSgiImage(SgiBytes(2, 2, 1, "\x01\x02\x03\x04"), "a.bw");
  EXPECT_EQ(texture.width, 2);
  EXPECT_EQ(texture.height, 2);
  EXPECT_THAT(texture.rgba, ElementsAre(3, 3, 3, 255, 4, 4, 4, 255, 1, 1, 1, 255, 2, 2, 2, 255));
}

TEST(SgiImage, GreyWithAlpha) {
  const SceneTexture texture = DecodeSgiImage(SgiBytes(2, 1, 2, "\x01\x02\x03\x04"), "a.rgb");
  EXPECT_THAT(texture.rgba, ElementsAre(1, 1, 1, 3, 2, 2, 2, 4));
}

TEST(SgiImage, ColourAndColourWithAlpha) {
  EXPECT_THAT(DecodeSgiImage(SgiBytes(1, 1, 3, "\x01\x02\x03"), "a.rgb").rgba,
              ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(DecodeSgiImage(SgiBytes(1, 1, 4, "\x01\x02\x03\x04"), "a.rgb").rgba,
              ElementsAre(1, 2, 3, 4));
}

TEST(SgiImage, SixteenBitsKeepTheHighByte) {
  std::string bytes = SgiBytes(2, 1, 1, "\x07\x7F\x09\x7F");
  bytes[3] = 2;
  EXPECT_THAT(DecodeSgiImage(bytes, "a.bw").rgba, ElementsAre(7, 7, 7, 255, 9, 9, 9, 255));
}

// One row of 5: three times 9, then 1 and 2.
std::string RunLengthCoded() {
  std::string bytes = SgiBytes(5, 1, 1, "");
  bytes[2] = 1;
  using namespace std::string_literals;
  bytes += "\0\0\2\x08"s;  // the row starts at 520
  bytes += "\0\0\0\x06"s;  // and has 6 bytes
  bytes += "\x03\x09\x82\x01\x02\0"s;
  return bytes;
}

TEST(SgiImage, RunLengthCodedRow) {
  const SceneTexture texture = DecodeSgiImage(RunLengthCoded(), "a.bw");
  EXPECT_THAT(texture.rgba,
              ElementsAre(9, 9, 9, 255, 9, 9, 9, 255, 9, 9, 9, 255, 1, 1, 1, 255, 2, 2, 2, 255));
}

TEST(SgiImage, RefusesCutOffData) {
  const std::string verbatim = SgiBytes(2, 2, 1, "\x01\x02\x03");
  EXPECT_THAT(InputErrorOf([&] { DecodeSgiImage(verbatim, "cut.rgb"); }), HasSubstr("cut.rgb"));
  const std::string runs = RunLengthCoded();
  for (std::size_t size = 0; size + 1 < runs.size(); ++size) {
    EXPECT_THROW(DecodeSgiImage(std::string_view(runs).substr(0, size), "cut.rgb"), InputError);
  }
}

TEST(SgiImage, RefusesImpossibleSizes) {
  EXPECT_THAT(InputErrorOf([] { DecodeSgiImage(SgiBytes(0, 1, 1, ""), "a.rgb"); }),
              HasSubstr("0x1"));
  EXPECT_THAT(InputErrorOf([] { DecodeSgiImage(SgiBytes(65535, 65535, 4, ""), "a.rgb"); }),
              HasSubstr("65535x65535"));
  EXPECT_THAT(InputErrorOf([] { DecodeSgiImage(SgiBytes(1, 1, 5, "abcde"), "a.rgb"); }),
              HasSubstr("5 channels"));
}

}  // namespace
}  // namespace lift_slam
