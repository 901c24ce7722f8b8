#include "lift_slam/util/shipped_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lift_slam {
namespace {

class ShippedFileTest : public testing::Test {
 protected:
  ~ShippedFileTest() override { unsetenv("LIFT_SLAM_SHARE_DIR"); }
};

TEST_F(ShippedFileTest, OfTheSourceTreeInABuild) {
  EXPECT_TRUE(std::filesystem::is_regular_file(ShippedFile("configs/paper_results.yaml")));
  EXPECT_TRUE(std::filesystem::is_directory(ShippedFile("vocabularies")));
}

TEST_F(ShippedFileTest, OfTheNamedFolderFirst) {
  setenv("LIFT_SLAM_SHARE_DIR", "/nowhere", /*overwrite=*/1);
  EXPECT_EQ(ShippedFile("weights/a.safetensors"), "/nowhere/weights/a.safetensors");
}

TEST_F(ShippedFileTest, AnEmptyVariableNamesNone) {
  setenv("LIFT_SLAM_SHARE_DIR", "", /*overwrite=*/1);
  EXPECT_TRUE(std::filesystem::is_directory(ShippedFile("configs")));
}

}  // namespace
}  // namespace lift_slam
