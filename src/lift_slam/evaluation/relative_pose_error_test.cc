#include "lift_slam/evaluation/relative_pose_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lift_slam/evaluation/test_data.h"

namespace lift_slam {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::vector<PosePair> Pairs(const Trajectory& estimate, const Trajectory& reference) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    pairs.push_back({i, i, estimate[i].world_from_cam, reference[i].world_from_cam});
  }
  return pairs;
}

TEST(RelativePoseError, DriftPerFrameOnAStraightLine) {
  const double yaw_rad = 0.01;
  const auto pairs = Pairs(test::StraightLine(50, 1.02, yaw_rad), test::StraightLine(50, 1.0));
  std::vector<std::int64_t> frames(50);
  for (int i = 0; i < 50; ++i) frames[static_cast<std::size_t>(i)] = i;
  const auto error = ComputeRelativePoseError(pairs, frames, {});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->rotation_deg.count, 49U);
  EXPECT_NEAR(error->rotation_deg.rmse, yaw_rad * 180.0 / std::numbers::pi, 1e-10);
  const auto straight = ComputeRelativePoseError(
      Pairs(test::StraightLine(50, 1.02), test::StraightLine(50, 1.0)), frames, {.delta = 5});
  EXPECT_NEAR(straight->translation_m.mean, 0.1, 1e-10);
}

TEST(RelativePoseError, AGapIsNotOneStep) {
  const auto pairs = Pairs(test::StraightLine(6, 1.0), test::StraightLine(6, 1.0));
  const std::vector<std::int64_t> frames = {0, 1, 2, 5, 6, 7};
  EXPECT_THAT(ChooseRpePairs(pairs, frames, {}),
              ElementsAre(Pair(0, 1), Pair(1, 2), Pair(3, 4), Pair(4, 5)));
  EXPECT_THAT(ChooseRpePairs(pairs, frames, {.delta = 2, .pairs = RpePairs::kConsecutive}),
              ElementsAre(Pair(0, 2), Pair(3, 5)));
}

TEST(RelativePoseError, MetresAreMeasuredAlongTheChosenPath) {
  const auto pairs = Pairs(test::StraightLine(9, 2.0), test::StraightLine(9, 1.0));
  const std::vector<std::int64_t> frames = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  RpeOptions options;
  options.delta = 4.0;
  options.unit = RpeUnit::kMetres;
  EXPECT_THAT(ChooseRpePairs(pairs, frames, options),
              ElementsAre(Pair(0, 4), Pair(1, 5), Pair(2, 6), Pair(3, 7), Pair(4, 8)));
  options.pairs = RpePairs::kConsecutive;
  EXPECT_THAT(ChooseRpePairs(pairs, frames, options), ElementsAre(Pair(4, 8)));
  options.path_source = RpePathSource::kEstimate;
  EXPECT_THAT(ChooseRpePairs(pairs, frames, options),
              ElementsAre(Pair(2, 4), Pair(4, 6), Pair(6, 8)));
}

TEST(RelativePoseError, NothingWithoutAPair) {
  const auto pairs = Pairs(test::StraightLine(2, 1.0), test::StraightLine(2, 1.0));
  EXPECT_EQ(ComputeRelativePoseError(pairs, std::vector<std::int64_t>{0, 5}, {}), std::nullopt);
}

}  // namespace
}  // namespace lift_slam
