#include "lift_slam/evaluation/kitti_error.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/geometry/sim3.h"

namespace lift_slam {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

EvaluationOptions FileOptions(AlignmentMode alignment) {
  EvaluationOptions options;
  options.alignment = alignment;
  options.estimate_lists_every_frame = false;
  return options;
}

Trajectory Transformed(Trajectory trajectory, const Sim3d& new_from_old) {
  for (TrajectoryPose& pose : trajectory) {
    pose.world_from_cam = TransformWorld(pose.world_from_cam, new_from_old);
  }
  return trajectory;
}

TEST(KittiError, StraightLineHas440SegmentsEachOneMetreTooLong) {
  const KittiError error = *Evaluate(test::StraightLine(1000, 1.01), test::StraightLine(1000, 1.0),
                                     FileOptions(AlignmentMode::kNone))
                                .kitti;
  EXPECT_EQ(error.all.num_segments, 440);
  ASSERT_EQ(error.by_length.size(), 8U);
  for (int i = 0; i < 8; ++i) {
    const KittiError::Length& length = error.by_length[static_cast<std::size_t>(i)];
    EXPECT_EQ(length.errors.num_segments, 90 - 10 * i);
    EXPECT_NEAR(length.errors.translation_pct, (length.length_m + 1.0) / length.length_m, 1e-9);
    EXPECT_NEAR(length.errors.rotation_deg_per_m, 0.0, 1e-12);
  }
  EXPECT_NEAR(error.all.translation_pct, 1.00436, 5e-6);
}

TEST(KittiError, ConstantYawDriftIsPerNominalLength) {
  const double drift_rad = 1e-4;
  const KittiError error =
      *Evaluate(test::StraightLine(1000, 1.0, drift_rad), test::StraightLine(1000, 1.0),
                FileOptions(AlignmentMode::kNone))
           .kitti;
  for (const KittiError::Length& length : error.by_length) {
    EXPECT_NEAR(length.errors.rotation_deg_per_m,
                drift_rad * (length.length_m + 1.0) / length.length_m * kDegPerRad, 1e-12);
  }
}

TEST(KittiError, RigidMotionOfTheEstimateChangesNothing) {
  const Trajectory reference = test::RandomWalk(600, 1);
  Trajectory estimate = test::RandomWalk(600, 1);
  Random random(2);
  for (TrajectoryPose& pose : estimate) {
    pose.world_from_cam = pose.world_from_cam *
                          Rigid3d(Eigen::Quaterniond::Identity(), 0.5 * test::RandomVector(random));
  }
  const EvaluationOptions options = FileOptions(AlignmentMode::kNone);
  const SegmentErrors plain = Evaluate(estimate, reference, options).kitti->all;
  const Sim3d rigid(1.0, test::RandomRotation(random), 50.0 * test::RandomVector(random));
  const SegmentErrors moved = Evaluate(Transformed(estimate, rigid), reference, options).kitti->all;
  EXPECT_GT(plain.num_segments, 50);
  EXPECT_GT(plain.translation_pct, 0.1);
  EXPECT_NEAR(moved.translation_pct, plain.translation_pct, 1e-9);
  EXPECT_NEAR(moved.rotation_deg_per_m, plain.rotation_deg_per_m, 1e-9);
  const SegmentErrors aligned =
      Evaluate(estimate, reference, FileOptions(AlignmentMode::kSe3)).kitti->all;
  EXPECT_NEAR(aligned.translation_pct, plain.translation_pct, 1e-9);
}

TEST(KittiError, SimilarityOfTheEstimateLeavesTheRotationError) {
  const Trajectory reference = test::RandomWalk(400, 3);
  const Trajectory estimate = test::RandomWalk(400, 4);
  Random random(5);
  const Sim3d similarity(0.037, test::RandomRotation(random), test::RandomVector(random));
  const EvaluationOptions options = FileOptions(AlignmentMode::kNone);
  EXPECT_NEAR(
      Evaluate(Transformed(estimate, similarity), reference, options).kitti->all.rotation_deg_per_m,
      Evaluate(estimate, reference, options).kitti->all.rotation_deg_per_m, 1e-9);
}

TEST(KittiError, Sim3AndItsScaleAloneGiveTheSameTranslationError) {
  const Trajectory reference = test::RandomWalk(400, 6);
  Random random(7);
  Trajectory estimate =
      Transformed(reference, Sim3d(0.2, test::RandomRotation(random), test::RandomVector(random)));
  for (TrajectoryPose& pose : estimate) {
    pose.world_from_cam.translation += 0.1 * test::RandomVector(random);
  }
  const SegmentErrors sim3 =
      Evaluate(estimate, reference, FileOptions(AlignmentMode::kSim3)).kitti->all;
  const SegmentErrors scale =
      Evaluate(estimate, reference, FileOptions(AlignmentMode::kScaleSim3)).kitti->all;
  EXPECT_GT(sim3.translation_pct, 0.1);
  EXPECT_NEAR(sim3.translation_pct, scale.translation_pct, 1e-9);
}

TEST(KittiError, MissingFramesLowerTheSegmentCountNotTheValues) {
  const Trajectory reference = test::RandomWalk(1000, 8);
  Trajectory estimate;
  for (const TrajectoryPose& pose : reference) {
    if (pose.frame_index % 3 != 2) estimate.push_back(pose);
  }
  const EvaluationOptions options = FileOptions(AlignmentMode::kSim3);
  const SegmentErrors whole = Evaluate(reference, reference, options).kitti->all;
  const EvaluationResult thinned = Evaluate(estimate, reference, options);
  EXPECT_LT(thinned.kitti->all.num_segments, whole.num_segments);
  EXPECT_GT(thinned.kitti->all.num_segments, whole.num_segments / 4);
  EXPECT_NEAR(thinned.kitti->all.translation_pct, 0.0, 1e-9);
  EXPECT_NEAR(thinned.kitti->all.rotation_deg_per_m, 0.0, 1e-9);
  EXPECT_NEAR(thinned.ate_m->rmse, 0.0, 1e-9);
  EXPECT_EQ(thinned.association.num_unpaired_reference, 333U);
}

TEST(KittiError, ShortPathHasNoSegments) {
  const EvaluationResult result =
      Evaluate(test::StraightLine(100, 1.0), test::StraightLine(100, 1.0),
               FileOptions(AlignmentMode::kNone));
  EXPECT_EQ(result.kitti->all.num_segments, 0);
}

}  // namespace
}  // namespace lift_slam
