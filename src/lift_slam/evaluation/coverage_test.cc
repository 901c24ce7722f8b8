#include "lift_slam/evaluation/coverage.h"

#include <gtest/gtest.h>

#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// One entry per character: '+' has a pose, '.' not initialised, '-' lost.
Trajectory FromStates(const std::string& states) {
  Trajectory trajectory = test::StraightLine(static_cast<int>(states.size()), 1.0);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] == '.') trajectory[i].state = PoseState::kNotInitialized;
    if (states[i] == '-') trajectory[i].state = PoseState::kLost;
  }
  return trajectory;
}

Coverage CoverageOf(const Trajectory& estimate, const Trajectory& reference = {},
                    EvaluationOptions options = {}) {
  options.alignment = AlignmentMode::kNone;
  return Evaluate(estimate, reference, options).coverage;
}

Trajectory OkPosesOf(const Trajectory& trajectory, bool keep_index) {
  Trajectory poses;
  for (TrajectoryPose pose : trajectory) {
    if (!keep_index) pose.frame_index = -1;
    if (pose.state == PoseState::kOk) poses.push_back(pose);
  }
  return poses;
}

TEST(Coverage, CountsFramesRunsAndLosses) {
  const Coverage coverage = CoverageOf(FromStates("..+++-++++--+."));
  EXPECT_EQ(coverage.source, FrameListSource::kEstimate);
  EXPECT_EQ(coverage.frames_total, 14);
  EXPECT_EQ(coverage.frames_ok, 8);
  EXPECT_DOUBLE_EQ(coverage.coverage, 8.0 / 14.0);
  EXPECT_EQ(coverage.init_frame, 2);
  EXPECT_EQ(coverage.lost_events, 3);
  EXPECT_EQ(coverage.longest_ok_run, 4);
  EXPECT_NEAR(coverage.lost_at_end_s, 0.1, 1e-12);
  EXPECT_EQ(coverage.path_covered, std::nullopt);
  EXPECT_EQ(coverage.maps, std::nullopt);
}

TEST(Coverage, PathCoveredIsWeightedByReferenceLength) {
  Trajectory reference = test::StraightLine(11, 1.0);
  for (std::size_t i = 6; i < 11; ++i) reference[i].world_from_cam.translation.z() += 10.0;
  // Steps: 1 m each, but 11 m between frames 5 and 6; the gap at 5 loses 12 of 20 m.
  const Coverage coverage = CoverageOf(FromStates("+++++-+++++"), reference);
  ASSERT_TRUE(coverage.path_covered);
  EXPECT_NEAR(*coverage.path_covered, 8.0 / 20.0, 1e-12);
}

TEST(Coverage, StandingStillDoesNotHideAGap) {
  Trajectory reference = test::StraightLine(100, 1.0);
  for (std::size_t i = 10; i < 100; ++i) reference[i].world_from_cam = reference[9].world_from_cam;
  const Coverage coverage = CoverageOf(FromStates("-----" + std::string(95, '+')), reference);
  EXPECT_NEAR(coverage.coverage, 0.95, 1e-12);
  EXPECT_NEAR(*coverage.path_covered, 4.0 / 9.0, 1e-12);
}

TEST(Coverage, PartOfASequenceIsMeasuredAgainstThatPart) {
  const Trajectory reference = test::StraightLine(1000, 1.0);
  const Trajectory estimate(reference.begin() + 200, reference.begin() + 300);
  EXPECT_NEAR(*CoverageOf(estimate, reference).path_covered, 1.0, 1e-12);
}

TEST(Coverage, FileWithFrameIndicesCountsTheFramesOfTheReference) {
  EvaluationOptions options;
  options.estimate_lists_every_frame = false;
  const Trajectory reference = test::StraightLine(14, 1.0);
  const Coverage coverage =
      CoverageOf(OkPosesOf(FromStates("..+++-++++--+."), /*keep_index=*/true), reference, options);
  EXPECT_EQ(coverage.source, FrameListSource::kReference);
  EXPECT_EQ(coverage.frames_total, 14);
  EXPECT_EQ(coverage.init_frame, 2);
  EXPECT_EQ(coverage.lost_events, 3);
  EXPECT_NEAR(*coverage.path_covered, 5.0 / 13.0, 1e-12);
}

TEST(Coverage, FileWithTimesAloneInfersTheFramesFromItsRate) {
  EvaluationOptions options;
  options.estimate_lists_every_frame = false;
  options.association.max_time_difference_ms = 10.0;
  Trajectory reference;  // 100 Hz, ten times the rate of the frames
  for (int i = 0; i < 131; ++i) {
    TrajectoryPose pose;
    pose.timestamp_ns = i * std::int64_t{10'000'000};
    pose.world_from_cam.translation.z() = 0.1 * i;
    reference.push_back(pose);
  }
  const Coverage coverage =
      CoverageOf(OkPosesOf(FromStates("..+++-++++--+."), /*keep_index=*/false), reference, options);
  EXPECT_EQ(coverage.source, FrameListSource::kInferred);
  EXPECT_EQ(coverage.frames_total, 14);
  EXPECT_EQ(coverage.frames_ok, 8);
  EXPECT_EQ(coverage.init_frame, 2);
  EXPECT_EQ(coverage.lost_events, 3);
  EXPECT_NEAR(*coverage.path_covered, 5.0 / 13.0, 1e-9);
  options.frames_total = 20;
  EXPECT_NEAR(CoverageOf(OkPosesOf(FromStates("+++++"), false), reference, options).coverage, 0.25,
              1e-12);
  options.frames_total = 3;
  EXPECT_THROW(CoverageOf(OkPosesOf(FromStates("+++++"), false), reference, options), InputError);
}

TEST(Coverage, AKnownNumberOfFramesHidesNeitherStartNorEnd) {
  EvaluationOptions options;
  options.estimate_lists_every_frame = false;
  options.association.method = AssociationMethod::kTime;
  const Trajectory reference = test::StraightLine(400, 1.0);  // 40 s
  Trajectory estimate(reference.begin() + 30, reference.begin() + 240);
  estimate.erase(estimate.begin() + 50, estimate.begin() + 60);
  options.frames_total = 400;
  const Coverage coverage = CoverageOf(estimate, reference, options);
  EXPECT_EQ(coverage.frames_total, 400);
  EXPECT_EQ(coverage.init_frame, 30);
  EXPECT_EQ(coverage.lost_events, 2);
  EXPECT_NEAR(coverage.lost_at_end_s, 16.0, 1e-9);
  EXPECT_EQ(JudgeRun(coverage, {}), RunStatus::kFailLost);
  options.frames_total = 250;  // 210 listed, 30 before, so 10 after
  EXPECT_NEAR(CoverageOf(estimate, reference, options).lost_at_end_s, 1.0, 1e-9);
  options.frames_total = 220;
  EXPECT_EQ(CoverageOf(estimate, reference, options).init_frame, 10);
  EXPECT_EQ(CoverageOf(estimate, reference, options).lost_at_end_s, 0.0);
}

TEST(Coverage, AStampFarOffIsRefusedInsteadOfFilled) {
  Trajectory estimate = OkPosesOf(FromStates("+++++"), /*keep_index=*/false);
  Trajectory reference = test::StraightLine(5, 1.0);
  for (Trajectory* trajectory : {&estimate, &reference}) {
    for (TrajectoryPose& pose : *trajectory) pose.frame_index = -1;
  }
  EvaluationOptions options;
  options.estimate_lists_every_frame = false;
  options.association.method = AssociationMethod::kTime;
  estimate.back().timestamp_ns += 1'700'000'000'000'000'000;
  EXPECT_THROW(CoverageOf(estimate, reference, options), InputError);
  estimate.back().timestamp_ns = reference.back().timestamp_ns;
  EXPECT_EQ(CoverageOf(estimate, reference, options).frames_total, 5);
  reference.back().timestamp_ns += 1'700'000'000'000'000'000;
  EXPECT_THROW(CoverageOf(estimate, reference, options), InputError);
}

TEST(Coverage, TimesFileGivesEveryFrameItsState) {
  const Trajectory all = test::StraightLine(5, 1.0);
  const Trajectory complete =
      WithEveryFrame({all[1], all[3]}, {0, 100'000'000, 200'000'000, 300'000'000, 400'000'000});
  ASSERT_EQ(complete.size(), 5U);
  EXPECT_EQ(complete[0].state, PoseState::kNotInitialized);
  EXPECT_EQ(complete[1].state, PoseState::kOk);
  EXPECT_EQ(complete[2].state, PoseState::kLost);
  EXPECT_EQ(complete[3].frame_index, 3);
  EXPECT_EQ(complete[4].state, PoseState::kLost);
  EXPECT_THROW(WithEveryFrame({all[1]}, {0, 200'000'000}), InputError);
}

RunStatus StatusOf(const std::string& states) {
  return Evaluate(FromStates(states), {}, {}).status;
}

TEST(Status, FollowsTheThresholds) {
  EXPECT_EQ(StatusOf(std::string(20, '.')), RunStatus::kFailInit);
  EXPECT_EQ(StatusOf(""), RunStatus::kFailInit);
  EXPECT_EQ(StatusOf(std::string(51, '.') + std::string(49, '+')), RunStatus::kFailLost);
  EXPECT_EQ(StatusOf(std::string(50, '.') + std::string(50, '+')), RunStatus::kPartial);
  EXPECT_EQ(StatusOf(std::string(11, '.') + std::string(89, '+')), RunStatus::kPartial);
  EXPECT_EQ(StatusOf(std::string(10, '.') + std::string(90, '+')), RunStatus::kOk);
}

TEST(Status, LostForTenSecondsAtTheEndIsAFailure) {
  EXPECT_EQ(StatusOf(std::string(2000, '+') + std::string(100, '-')), RunStatus::kOk);
  EXPECT_EQ(StatusOf(std::string(2000, '+') + std::string(101, '-')), RunStatus::kFailLost);
  EXPECT_EQ(StatusOf(std::string(2000, '+') + std::string(101, '-') + "+"), RunStatus::kOk);
}

TEST(Status, NamesAreThoseOfTheResultFile) {
  EXPECT_EQ(Name(RunStatus::kOk), "OK");
  EXPECT_EQ(Name(RunStatus::kPartial), "PARTIAL");
  EXPECT_EQ(Name(RunStatus::kFailInit), "FAIL_INIT");
  EXPECT_EQ(Name(RunStatus::kFailLost), "FAIL_LOST");
}

}  // namespace
}  // namespace lift_slam
