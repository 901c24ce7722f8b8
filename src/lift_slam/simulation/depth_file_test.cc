#include "lift_slam/simulation/depth_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "lift_slam/simulation/sequence_folder.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

DepthImage ReadBack(const DepthImage& image, DepthFormat format) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / ("depth" + DepthExtension(format));
  WriteBytesAtomically(file, EncodeDepth(image, format));
  return ReadDepth(file);
}

TEST(DepthFile, PngKeepsDepthToHalfAUnitAndDropsWhatIsTooFar) {
  const DepthImage image{3, 2, {0.0F, 1.0F, 12.3456F, 255.99F, 256.5F, 1000.0F}};
  const DepthImage back = ReadBack(image, DepthFormat::kPng16);
  ASSERT_EQ(back.width, 3);
  ASSERT_EQ(back.height, 2);
  EXPECT_EQ(back.depth_m[0], 0.0F);
  EXPECT_EQ(back.depth_m[1], 1.0F);
  EXPECT_NEAR(back.depth_m[2], 12.3456F, 0.5 / 256);
  EXPECT_NEAR(back.depth_m[3], 255.99F, 0.5 / 256);
  EXPECT_EQ(back.depth_m[4], 0.0F);
  EXPECT_EQ(back.depth_m[5], 0.0F);
}

TEST(DepthFile, TiffIsExact) {
  const DepthImage image{2, 2, {0.0F, 0.123456789F, 12.3456F, 2987.654F}};
  EXPECT_EQ(ReadBack(image, DepthFormat::kTiff32).depth_m, image.depth_m);
}

TEST(DepthFile, RefusesWhatIsNone) {
  EXPECT_THROW(ReadDepth("/nonexistent/depth.png"), InputError);
}

}  // namespace
}  // namespace lift_slam
