#include "lift_slam/simulation/pair_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/test_views.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// A wall at z = 10 m, seen straight on from poses along x.
DepthImage Wall() { return {64, 48, std::vector<float>(std::size_t{64} * 48, 10.0F)}; }

Rigid3d AtX(double x) { return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}}; }

double OverlapWhenShifted(double x) {
  return Overlap(TestCamera(), Wall(), Inverse(AtX(0.0)), Wall(), Inverse(AtX(x)));
}

TEST(Overlap, IsTheShareStillInTheOtherImage) {
  EXPECT_EQ(OverlapWhenShifted(0.0), 1.0);
  // 4 m sideways are 16 of 64 pixels.
  EXPECT_NEAR(OverlapWhenShifted(4.0), 0.75, 0.03);
  EXPECT_EQ(OverlapWhenShifted(20.0), 0.0);
}

TEST(Overlap, LeavesOutWhatIsHiddenAndTheSky) {
  DepthImage hidden = Wall();
  for (std::size_t i = 0; i < hidden.depth_m.size() / 2; ++i) hidden.depth_m[i] = 3.0F;
  EXPECT_NEAR(Overlap(TestCamera(), Wall(), Rigid3d(), hidden, Rigid3d()), 0.5, 0.03);
  DepthImage sky = Wall();
  for (std::size_t i = 0; i < sky.depth_m.size() / 2; ++i) sky.depth_m[i] = 0.0F;
  EXPECT_NEAR(Overlap(TestCamera(), sky, Rigid3d(), Wall(), Rigid3d()), 0.5, 0.03);
}

TEST(ListPairs, KeepsPairsWithinAllLimits) {
  std::vector<Rigid3d> poses;
  for (int i = 0; i < 12; ++i) poses.push_back(AtX(1.0 * i));
  PairOptions options;
  options.max_distance_m = 5.5;
  options.min_overlap = 0.73;
  const auto pairs = ListPairs(
      TestCamera(), poses, [](int) { return Wall(); }, options, 1);
  ASSERT_FALSE(pairs.empty());
  for (const FramePair& pair : pairs) {
    EXPECT_LT(pair.first, pair.second);
    EXPECT_NEAR(pair.distance_m, pair.second - pair.first, 1e-9);
    EXPECT_GE(pair.overlap, 0.73);
    EXPECT_LE(pair.distance_m, 4.0);  // farther ones overlap less
  }
}

TEST(ListPairs, ChoosesAsManyAsAskedAlwaysTheSame) {
  const std::vector<Rigid3d> poses(30, AtX(0.0));
  PairOptions options;
  options.max_pairs_per_frame = 4;
  const auto read = [](int) { return Wall(); };
  const auto pairs = ListPairs(TestCamera(), poses, read, options, 1);
  EXPECT_EQ(pairs.size(), 26U * 4 + 3 + 2 + 1);
  EXPECT_EQ(PairsText(pairs), PairsText(ListPairs(TestCamera(), poses, read, options, 1)));
  EXPECT_NE(PairsText(pairs), PairsText(ListPairs(TestCamera(), poses, read, options, 2)));
}

TEST(PairOptions, RefuseWhatCannotBe) {
  PairOptions options;
  options.min_overlap = 1.5;
  EXPECT_THROW(options.Check(), InputError);
}

}  // namespace
}  // namespace lift_slam
