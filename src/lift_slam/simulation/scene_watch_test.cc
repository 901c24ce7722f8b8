#include "lift_slam/simulation/scene_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

std::vector<Rigid3d> PosesAlongX(int count) {
  std::vector<Rigid3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back({Eigen::Quaterniond::Identity(), {1.0 * i, 0, 1}});
  return poses;
}

TEST(CheckInsideScene, NamesTheFirstFrameOutsideAndThePlace) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(6.5, 1, 3));
  EXPECT_NO_THROW(CheckInsideScene(PosesAlongX(7), box));
  try {
    CheckInsideScene(PosesAlongX(20), box);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 7 is at (7.0, 0.0, 1.0) m"));
  }
}

TEST(EmptyFrameWatch, RefusesManyEmptyFramesInARowWhateverTheirOrder) {
  const std::vector<Rigid3d> poses = PosesAlongX(40);
  EmptyFrameWatch watch(poses);
  constexpr int kFirst = 3, kCount = EmptyFrameWatch::kMaxEmptyInARow;
  for (int i = kFirst + kCount - 1; i > 0; --i) watch.Tell(i, i >= kFirst);
  try {
    watch.Tell(0, false);  // closes the gap
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("from frame 3 at (3.0, 0.0, 1.0) m"));
  }
}

TEST(EmptyFrameWatch, AcceptsAFewEmptyFrames) {
  const std::vector<Rigid3d> poses = PosesAlongX(40);
  EmptyFrameWatch watch(poses);
  for (int i = 0; i < 40; ++i)
    EXPECT_NO_THROW(watch.Tell(i, i % EmptyFrameWatch::kMaxEmptyInARow != 0));
}

}  // namespace
}  // namespace lift_slam
