#include "lift_slam/util/environment.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lift_slam {
namespace {

TEST(EnvironmentPath, IsWhatTheVariableNamesIfAnything) {
  constexpr const char* kVariable = "LIFT_SLAM_TEST_OF_ENVIRONMENT";
  unsetenv(kVariable);
  EXPECT_FALSE(EnvironmentPath(kVariable));
  setenv(kVariable, "", /*overwrite=*/1);
  EXPECT_FALSE(EnvironmentPath(kVariable));
  setenv(kVariable, "/data/a b", /*overwrite=*/1);
  EXPECT_EQ(EnvironmentPath(kVariable), "/data/a b");
  unsetenv(kVariable);
}

}  // namespace
}  // namespace lift_slam
