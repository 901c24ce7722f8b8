#include "lift_slam/features/lift/default_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class DefaultWeightsTest : public testing::Test {
 protected:
  ~DefaultWeightsTest() override { unsetenv("LIFT_SLAM_WEIGHTS"); }
  void Choose(const std::filesystem::path& path) {
    setenv("LIFT_SLAM_WEIGHTS", path.c_str(), /*overwrite=*/1);
  }

  TemporaryFolder folder_;
};

TEST_F(DefaultWeightsTest, TheVariableNamesThem) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 1);
  WriteLiftWeights(weights, folder_ / "mine.safetensors");
  Choose(folder_ / "mine.safetensors");
  EXPECT_EQ(ReadLiftWeightsOrDefault("").sha256, weights.sha256);
  Choose("");
  EXPECT_EQ(DefaultLiftWeights().filename(), "lift-default.safetensors");
}

TEST_F(DefaultWeightsTest, ANamedFileComesFirst) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 2);
  WriteLiftWeights(weights, folder_ / "named.safetensors");
  Choose(folder_ / "nowhere.safetensors");
  EXPECT_EQ(ReadLiftWeightsOrDefault(folder_ / "named.safetensors").sha256, weights.sha256);
}

TEST_F(DefaultWeightsTest, MissingOnesAreExplained) {
  Choose(folder_ / "nowhere.safetensors");
  try {
    ReadLiftWeightsOrDefault("");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nowhere.safetensors"));
    EXPECT_THAT(error.what(), HasSubstr("--weights FILE"));
  }
}

// What ships can be used as it is: upright or not, in int8, with adaptive thresholds.
TEST_F(DefaultWeightsTest, WhatShipsIsComplete) {
  if (!std::filesystem::exists(DefaultLiftWeights())) GTEST_SKIP() << "no weights are there";
  const LiftWeights weights = ReadLiftWeightsOrDefault("");
  EXPECT_TRUE(weights.orientation.has_value());
  EXPECT_TRUE(weights.distances.has_value());
  EXPECT_EQ(weights.descriptor_ranges.size(), 3U);
  EXPECT_THAT(weights.provenance, HasSubstr("images:"));
}

}  // namespace
}  // namespace lift_slam
