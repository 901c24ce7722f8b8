#include "lift_slam/evaluation/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Poses at the given milliseconds, x = time in seconds, without frame index.
Trajectory AtMilliseconds(const std::vector<double>& stamps_ms) {
  Trajectory trajectory;
  for (const double ms : stamps_ms) {
    TrajectoryPose pose;
    pose.timestamp_ns = static_cast<std::int64_t>(ms * 1e6);
    pose.world_from_cam.translation.x() = 1e-3 * ms;
    trajectory.push_back(pose);
  }
  return trajectory;
}

std::string ErrorOf(const Trajectory& estimate, const Trajectory& reference,
                    const AssociationOptions& options = {}) {
  try {
    Associate(estimate, reference, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Association, TwoEstimatesNearOneReferenceGiveOnePairTheCloser) {
  const Association association =
      Associate(AtMilliseconds({95, 102}), AtMilliseconds({100, 500}), {});
  ASSERT_EQ(association.pairs.size(), 1U);
  EXPECT_EQ(association.pairs[0].estimate_index, 1U);
  EXPECT_EQ(association.pairs[0].reference_index, 0U);
  EXPECT_EQ(association.num_unpaired_estimate, 1U);
  EXPECT_EQ(association.num_unpaired_reference, 1U);
  EXPECT_NEAR(association.max_time_difference_s, 0.002, 1e-12);
}

TEST(Association, TheLoserTakesTheNextFreeReference) {
  const Association association =
      Associate(AtMilliseconds({100, 104}), AtMilliseconds({101, 103, 119}), {});
  ASSERT_EQ(association.pairs.size(), 2U);
  EXPECT_EQ(association.pairs[0].reference_index, 0U);
  EXPECT_EQ(association.pairs[1].reference_index, 1U);
}

TEST(Association, LimitIsInclusiveAndOffsetShiftsTheEstimate) {
  const Trajectory estimate = AtMilliseconds({0, 1000});
  const Trajectory reference = AtMilliseconds({20, 1021});
  EXPECT_EQ(Associate(estimate, reference, {}).pairs.size(), 1U);
  EXPECT_EQ(Associate(estimate, reference, {.offset_s = 0.02}).pairs.size(), 2U);
}

TEST(Association, UnitMixUpIsNamed) {
  Trajectory nanoseconds = AtMilliseconds({1000, 2000});
  for (TrajectoryPose& pose : nanoseconds) pose.timestamp_ns *= 1'000'000'000;
  EXPECT_THAT(ErrorOf(nanoseconds, AtMilliseconds({1000, 2000})),
              AllOf(HasSubstr("1000000000.000000000 to 2000000000.000000000 s"),
                    HasSubstr("1.000000000 to 2.000000000 s"), HasSubstr("wrong unit")));
  const std::string apart = ErrorOf(AtMilliseconds({1000, 2000}), AtMilliseconds({3000, 4000}));
  EXPECT_THAT(apart, HasSubstr("3.000000000 to 4.000000000 s"));
  EXPECT_THAT(apart, Not(HasSubstr("wrong unit")));
}

TEST(Association, EmptyReferenceIsAnErrorAndEstimateWithoutPoseIsNot) {
  Trajectory lost = AtMilliseconds({100});
  lost[0].state = PoseState::kLost;
  EXPECT_TRUE(Associate(lost, AtMilliseconds({100}), {}).pairs.empty());
  EXPECT_THAT(ErrorOf(AtMilliseconds({100}), lost), HasSubstr("reference"));
}

TEST(Association, OnlyOkPosesTakePart) {
  Trajectory estimate = AtMilliseconds({0, 100, 200});
  estimate[1].state = PoseState::kLost;
  const Association association = Associate(estimate, AtMilliseconds({0, 100, 200}), {});
  ASSERT_EQ(association.pairs.size(), 2U);
  EXPECT_EQ(association.pairs[1].estimate_index, 2U);
}

TEST(Association, IndexPairsAreNeverShifted) {
  const Trajectory reference = test::RandomWalk(10, 1);
  const Trajectory estimate = {reference[2], reference[3], reference[7]};
  const Association association = Associate(estimate, reference, {});
  EXPECT_EQ(association.method, AssociationMethod::kIndex);
  ASSERT_EQ(association.pairs.size(), 3U);
  EXPECT_EQ(association.pairs[0].reference_index, 2U);
  EXPECT_EQ(association.pairs[2].reference_index, 7U);
  EXPECT_THAT(ErrorOf({reference[8]}, {reference[0], reference[1]}),
              HasSubstr("frames 8 to 8, the reference 0 to 1"));
  EXPECT_THAT(ErrorOf(AtMilliseconds({1}), reference, {.method = AssociationMethod::kIndex}),
              HasSubstr("frame index"));
}

TEST(Association, InterpolatesTheDenserTrajectoryWithoutExtrapolation) {
  AssociationOptions options;
  options.interpolate = true;
  options.max_time_difference_ms = 20.0;
  const Trajectory sparse = AtMilliseconds({-5, 7, 13, 95, 200});
  const Trajectory dense = AtMilliseconds({0, 10, 20, 30, 40, 50, 60, 70, 80, 130, 140, 150, 160});
  const Association association = Associate(sparse, dense, options);
  ASSERT_EQ(association.pairs.size(), 3U);  // -5 and 200 are outside
  for (const PosePair& pair : association.pairs) {
    EXPECT_NEAR(pair.reference.translation.x(), pair.estimate.translation.x(), 1e-12);
  }
  EXPECT_EQ(association.pairs[2].estimate_index, 3U);
  options.max_time_difference_ms = 17.0;  // 95 ms is 35 ms from 130 ms
  EXPECT_EQ(Associate(sparse, dense, options).pairs.size(), 2U);
  const Association swapped = Associate(dense, sparse, options);
  ASSERT_EQ(swapped.pairs.size(), 2U);
  EXPECT_NEAR(swapped.pairs[0].estimate.translation.x(), 0.007, 1e-12);
}

}  // namespace
}  // namespace lift_slam
