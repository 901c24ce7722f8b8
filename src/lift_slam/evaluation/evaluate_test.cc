#include "lift_slam/evaluation/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/evaluation/result_table.h"
#include "lift_slam/evaluation/run_statistics.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

Trajectory Transformed(Trajectory trajectory, const Sim3d& new_from_old) {
  for (TrajectoryPose& pose : trajectory) {
    pose.world_from_cam = TransformWorld(pose.world_from_cam, new_from_old);
  }
  return trajectory;
}

TEST(ErrorStatistics, OfKnownNumbers) {
  const ErrorStatistics statistics = *Summarize({4.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(statistics.mean, 2.5);
  EXPECT_DOUBLE_EQ(statistics.median, 2.5);
  EXPECT_DOUBLE_EQ(statistics.std, std::sqrt(1.25));
  EXPECT_EQ(statistics.min, 1.0);
  EXPECT_EQ(statistics.max, 4.0);
  EXPECT_EQ(Summarize({5.0, 1.0, 2.0})->median, 2.0);
  EXPECT_EQ(Summarize({}), std::nullopt);
}

TEST(Evaluate, IdentityHasNoError) {
  const Trajectory reference = test::RandomWalk(1000, 1);
  const EvaluationResult result = Evaluate(reference, reference, {});
  EXPECT_LT(result.ate_m->rmse, 1e-12);
  EXPECT_EQ(result.ate_m->count, 1000U);
  EXPECT_LT(result.ate_rotation_deg->max, 1e-9);
  EXPECT_LT(result.kitti->all.translation_pct, 1e-9);
  EXPECT_LT(result.kitti->all.rotation_deg_per_m, 1e-12);
  EXPECT_LT(result.rpe->translation_m.rmse, 1e-12);
  EXPECT_EQ(result.coverage.coverage, 1.0);
  EXPECT_NEAR(*result.coverage.path_covered, 1.0, 1e-12);
  EXPECT_EQ(result.status, RunStatus::kOk);
}

TEST(Evaluate, Sim3UndoesASimilarityAndHandsOutTheAlignedTrajectory) {
  const Trajectory reference = test::RandomWalk(300, 2);
  Random random(3);
  const Sim3d similarity(0.05, test::RandomRotation(random), test::RandomVector(random));
  const EvaluationResult result = Evaluate(Transformed(reference, similarity), reference, {});
  EXPECT_LT(result.ate_m->rmse, 1e-9);
  EXPECT_NEAR(result.reference_from_estimate->scale, 20.0, 1e-9);
  ASSERT_EQ(result.aligned_estimate.size(), 300U);
  EXPECT_LT((result.aligned_estimate[77].world_from_cam.translation -
             reference[77].world_from_cam.translation)
                .norm(),
            1e-9);
  EvaluationOptions options;
  options.alignment = AlignmentMode::kSe3;
  EXPECT_GT(Evaluate(Transformed(reference, similarity), reference, options).ate_m->rmse, 1.0);
}

TEST(Evaluate, AlignFirstIgnoresTheDriftThatFollows) {
  const Trajectory reference = test::RandomWalk(300, 4);
  Trajectory estimate = reference;
  for (std::size_t i = 150; i < 300; ++i) estimate[i].world_from_cam.translation.x() += 5.0;
  EvaluationOptions options;
  options.align_first = 100;
  const EvaluationResult result = Evaluate(estimate, reference, options);
  EXPECT_EQ(result.num_alignment_pairs, 100U);
  EXPECT_NEAR(result.ate_m->rmse, 5.0 * std::sqrt(0.5), 1e-9);
  ASSERT_EQ(result.frame_errors.size(), 300U);
  EXPECT_NEAR(result.frame_errors[149].position_m, 0.0, 1e-9);
  EXPECT_NEAR(result.frame_errors[150].position_m, 5.0, 1e-9);
}

// Frame by frame without error, but the two pieces do not belong together.
Trajectory WithGapOfTenSeconds(Trajectory trajectory) {
  trajectory.erase(trajectory.begin() + 50, trajectory.begin() + 150);
  for (std::size_t i = 50; i < trajectory.size(); ++i) {
    trajectory[i].world_from_cam.translation.x() += 5.0;
  }
  return trajectory;
}

TEST(Evaluate, AGapIsNoStepOfTheRelativeError) {
  Trajectory reference = test::RandomWalk(300, 11);
  EvaluationOptions options;
  options.alignment = AlignmentMode::kNone;
  options.estimate_lists_every_frame = false;
  for (const AssociationMethod method : {AssociationMethod::kTime, AssociationMethod::kIndex}) {
    options.association.method = method;
    const auto rpe = Evaluate(WithGapOfTenSeconds(reference), reference, options).rpe;
    EXPECT_EQ(rpe->translation_m.count, 198U);  // two pieces of 50 and 150 frames
    EXPECT_LT(rpe->translation_m.max, 1e-9);
    // A reference of the same frames: its places in the file do not tell the gap either.
    const Trajectory part = WithGapOfTenSeconds(reference);
    Trajectory whole = reference;
    whole.erase(whole.begin() + 50, whole.begin() + 150);
    EXPECT_LT(Evaluate(part, whole, options).rpe->translation_m.max, 1e-9);
  }
}

TEST(Evaluate, DegenerateAlignmentGivesAReasonAndNoNumber) {
  const Trajectory line = test::StraightLine(1000, 1.0);
  const EvaluationResult result = Evaluate(line, line, {});
  EXPECT_EQ(result.ate_m, std::nullopt);
  EXPECT_THAT(result.no_errors_reason, HasSubstr("one line"));
  EXPECT_EQ(result.status, RunStatus::kOk);
  EvaluationOptions options;
  options.alignment = AlignmentMode::kScale;
  EXPECT_LT(Evaluate(line, line, options).ate_m->rmse, 1e-9);
}

TEST(Evaluate, NeverInitialisedIsAFailureNotAnError) {
  Trajectory estimate = test::RandomWalk(30, 5);
  for (TrajectoryPose& pose : estimate) pose.state = PoseState::kNotInitialized;
  const EvaluationResult result = Evaluate(estimate, test::RandomWalk(30, 5), {});
  EXPECT_EQ(result.status, RunStatus::kFailInit);
  EXPECT_THAT(result.no_errors_reason, HasSubstr("no pose"));
  EXPECT_EQ(result.coverage.init_frame, std::nullopt);
}

TEST(Evaluate, PosesThatAreNotFiniteAreRefused) {
  const Trajectory reference = test::RandomWalk(30, 6);
  Trajectory estimate = reference;
  estimate[3].world_from_cam.translation.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Evaluate(estimate, reference, {}), InputError);
  estimate[3].state = PoseState::kLost;
  EXPECT_NO_THROW(Evaluate(estimate, reference, {}));
}

TEST(Evaluate, OptionsOutOfRangeAreRefused) {
  const Trajectory reference = test::RandomWalk(30, 7);
  EvaluationOptions options;
  options.association.max_time_difference_ms = -1.0;
  EXPECT_THROW(Evaluate(reference, reference, options), InputError);
  options = {};
  options.rpe.delta = 0.5;
  EXPECT_THROW(Evaluate(reference, reference, options), InputError);
  options = {};
  options.status.min_ok_coverage = 0.1;
  EXPECT_THROW(Evaluate(reference, reference, options), InputError);
}

TEST(Evaluate, EachMapByItselfHidesTheJumpBetweenThem) {
  const Trajectory reference = test::RandomWalk(200, 8);
  Random random(9);
  const Sim3d other(3.0, test::RandomRotation(random), test::RandomVector(random));
  Trajectory estimate = reference;
  std::vector<int> maps(200, 0);
  maps[0] = -1;
  for (std::size_t i = 100; i < 200; ++i) {
    estimate[i].world_from_cam = TransformWorld(estimate[i].world_from_cam, other);
    maps[i] = 1;
  }
  EXPECT_GT(Evaluate(estimate, reference, {}).ate_m->rmse, 1.0);
  const auto each = EvaluateEachMap(estimate, maps, reference, {});
  ASSERT_EQ(each.size(), 2U);
  EXPECT_EQ(each[0].num_poses, 99U);
  EXPECT_LT(each[0].ate_m->rmse, 1e-9);
  EXPECT_LT(each[1].ate_m->rmse, 1e-9);
}

TEST(ResultJson, HasTheFieldsOfTheSchema) {
  const Trajectory reference = test::RandomWalk(300, 10);
  EvaluationResult result = Evaluate(reference, reference, {});
  result.dataset = "kitti";
  result.sequence = "00";
  result.coverage.maps = 1;
  const nlohmann::json json = ToJson(result);
  EXPECT_EQ(json.at("status"), "OK");
  EXPECT_EQ(json.at("dataset"), "kitti");
  EXPECT_EQ(json.at("mode"), "final");
  EXPECT_EQ(json.at("gt_frame"), "cam");
  for (const char* field : {"/ate/rmse",
                            "/ate/mean",
                            "/ate/median",
                            "/ate/std",
                            "/ate/min",
                            "/ate/max",
                            "/association/pairs",
                            "/association/median_dt",
                            "/association/max_dt",
                            "/alignment/s",
                            "/alignment/n",
                            "/kitti/t_rel_pct",
                            "/kitti/r_rel_deg_per_m",
                            "/kitti/r_rel_deg_per_100m",
                            "/kitti/segments",
                            "/coverage/coverage",
                            "/coverage/frames_total",
                            "/coverage/frames_ok",
                            "/coverage/maps",
                            "/coverage/path_covered",
                            "/rpe/translation_m/rmse"}) {
    const nlohmann::json::json_pointer pointer(field);
    ASSERT_TRUE(json.contains(pointer)) << field;
    EXPECT_TRUE(json.at(pointer).is_number()) << field;
  }
  EXPECT_EQ(json.at("alignment").at("R").size(), 3U);
  EXPECT_EQ(json.at("kitti").at("per_length").size(), 8U);
  EXPECT_EQ(json.at("kitti").at("per_length")[7].at("t_rel_pct"), nullptr);  // path too short
  EXPECT_EQ(json.at("coverage").at("loops_closed"), nullptr);                // unknown
}

TEST(ResultTable, ShowsUnitsAndNotAvailable) {
  const Trajectory line = test::StraightLine(50, 1.0);
  EvaluationOptions options;
  options.alignment = AlignmentMode::kNone;
  const std::string text = FormatResult(Evaluate(line, line, options));
  EXPECT_THAT(text, HasSubstr("ATE position [m]"));
  EXPECT_THAT(text, HasSubstr("r_rel[deg/100m]"));
  EXPECT_THAT(text, HasSubstr("n/a"));
  EXPECT_THAT(FormatResult(Evaluate(line, line, {})), HasSubstr("no errors: "));
}

TEST(RunStatistics, FailedRunsAreCountedButNotAveraged) {
  const RunStatistics statistics = SummarizeRuns({{RunStatus::kOk, 1.0},
                                                  {RunStatus::kPartial, 2.0},
                                                  {RunStatus::kFailLost, 100.0},
                                                  {RunStatus::kOk, 6.0},
                                                  {RunStatus::kFailInit, std::nullopt}});
  EXPECT_EQ(statistics.num_runs, 5);
  EXPECT_EQ(statistics.num_used, 3);
  EXPECT_EQ(statistics.num_partial, 1);
  EXPECT_DOUBLE_EQ(statistics.mean, 3.0);
  EXPECT_EQ(statistics.median, 2.0);
  EXPECT_EQ(statistics.min, 1.0);
  EXPECT_EQ(statistics.max, 6.0);
  EXPECT_EQ(SummarizeRuns({{RunStatus::kFailLost, 1.0}}).num_used, 0);
}

}  // namespace
}  // namespace lift_slam
