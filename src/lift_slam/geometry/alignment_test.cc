#include "lift_slam/geometry/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Poses = std::vector<Rigid3d>;

Eigen::Quaterniond RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized();
}

Eigen::Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

Poses RandomPath(Random& random, int size) {
  Poses poses;
  Eigen::Vector3d position = 10.0 * RandomVector(random);
  for (int i = 0; i < size; ++i) {
    position += RandomVector(random);
    poses.emplace_back(RandomRotation(random), position);
  }
  return poses;
}

Poses StraightPath(const Eigen::Vector3d& direction, int size) {
  Poses poses;
  for (int i = 0; i < size; ++i) poses.emplace_back(Eigen::Quaterniond::Identity(), i * direction);
  return poses;
}

Poses Transformed(const Poses& poses, const Sim3d& new_from_old) {
  Poses result;
  for (const Rigid3d& pose : poses) result.push_back(TransformWorld(pose, new_from_old));
  return result;
}

double Rmse(const Poses& estimate, const Poses& reference, const Alignment& alignment) {
  double sum = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    sum += (*alignment.reference_from_estimate * estimate[i].translation - reference[i].translation)
               .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(estimate.size()));
}

TEST(Alignment, Sim3RecoversARandomSimilarity) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Poses estimate = RandomPath(random, 100);
    const Sim3d truth(std::pow(10.0, random.Uniform(-2.0, 2.0)), RandomRotation(random),
                      100.0 * RandomVector(random));
    const Alignment alignment =
        AlignPoses(estimate, Transformed(estimate, truth), AlignmentMode::kSim3);
    ASSERT_TRUE(alignment.reference_from_estimate);
    const Sim3d& found = *alignment.reference_from_estimate;
    EXPECT_NEAR(found.scale / truth.scale, 1.0, 1e-9);
    EXPECT_LT(RotationAngle(found.rotation.conjugate() * truth.rotation), 1e-9);
    EXPECT_LT((found.translation - truth.translation).norm(), 1e-9 * truth.translation.norm());
  }
}

TEST(Alignment, Se3LeavesTheScaleError) {
  Random random(2);
  const Poses estimate = RandomPath(random, 100);
  const Poses reference =
      Transformed(estimate, Sim3d(1.5, RandomRotation(random), RandomVector(random)));
  const Alignment alignment = AlignPoses(estimate, reference, AlignmentMode::kSe3);
  ASSERT_TRUE(alignment.reference_from_estimate);
  EXPECT_EQ(alignment.reference_from_estimate->scale, 1.0);
  EXPECT_GT(Rmse(estimate, reference, alignment), 0.1);
}

TEST(Alignment, MirroredPathIsNotReachedByAnImproperRotation) {
  Random random(3);
  const Poses estimate = RandomPath(random, 100);
  Poses reference = estimate;
  for (Rigid3d& pose : reference) pose.translation.x() *= -1.0;
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3}) {
    const Alignment alignment = AlignPoses(estimate, reference, mode);
    ASSERT_TRUE(alignment.reference_from_estimate);
    EXPECT_GT(Rmse(estimate, reference, alignment), 0.1);
    EXPECT_NEAR(alignment.reference_from_estimate->rotation.toRotationMatrix().determinant(), 1.0,
                1e-12);
  }
}

TEST(Alignment, LeastSquaresIsNotBeatenByANearbySimilarity) {
  Random random(4);
  const Poses estimate = RandomPath(random, 60);
  Poses reference = Transformed(estimate, Sim3d(2.0, RandomRotation(random), RandomVector(random)));
  for (Rigid3d& pose : reference) pose.translation += 0.3 * RandomVector(random);
  const Alignment best = AlignPoses(estimate, reference, AlignmentMode::kSim3);
  const double best_rmse = Rmse(estimate, reference, best);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d axis = RandomVector(random).normalized();
    const Sim3d nudge(1.0 + 1e-3 * random.Normal(),
                      Eigen::Quaterniond(Eigen::AngleAxisd(1e-3 * random.Normal(), axis)),
                      1e-2 * RandomVector(random));
    const Alignment nudged{nudge * *best.reference_from_estimate, AlignmentFailure::kNone};
    EXPECT_GE(Rmse(estimate, reference, nudged), best_rmse - 1e-12);
  }
}

TEST(Alignment, StraightLineIsDegenerateForLeastSquaresButNotForScale) {
  const Poses estimate = StraightPath({0.1, 0.2, -0.3}, 1000);
  const Poses reference = StraightPath({0.2, 0.4, -0.6}, 1000);
  for (const AlignmentMode mode :
       {AlignmentMode::kSe3, AlignmentMode::kSim3, AlignmentMode::kScaleSim3}) {
    const Alignment alignment = AlignPoses(estimate, reference, mode);
    EXPECT_FALSE(alignment.reference_from_estimate);
    EXPECT_EQ(alignment.failure, AlignmentFailure::kCollinear);
  }
  const Alignment scale = AlignPoses(estimate, reference, AlignmentMode::kScale);
  ASSERT_TRUE(scale.reference_from_estimate);
  EXPECT_NEAR(scale.reference_from_estimate->scale, 2.0, 1e-12);
  EXPECT_LT(Rmse(estimate, reference, scale), 1e-9);
}

TEST(Alignment, PlanarPathHasRankTwoAndAligns) {
  Poses estimate;
  for (int i = 0; i < 20; ++i) {
    estimate.emplace_back(Eigen::Quaterniond::Identity(),
                          Eigen::Vector3d(std::cos(0.2 * i), 0.0, std::sin(0.2 * i)));
  }
  const Alignment alignment = AlignPoses(estimate, estimate, AlignmentMode::kSim3);
  ASSERT_TRUE(alignment.reference_from_estimate);
  EXPECT_LT(RotationAngle(alignment.reference_from_estimate->rotation), 1e-12);
}

TEST(Alignment, DegenerateInputGivesAReason) {
  const Poses two = StraightPath({1, 0, 0}, 2);
  EXPECT_EQ(AlignPoses(two, two, AlignmentMode::kSim3).failure, AlignmentFailure::kTooFewPoses);
  EXPECT_EQ(AlignPoses({}, {}, AlignmentMode::kOrigin).failure, AlignmentFailure::kTooFewPoses);
  Random random(6);
  const Poses moving = RandomPath(random, 50);
  const Poses still(50, Rigid3d(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.7, -0.3)));
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3}) {
    EXPECT_EQ(AlignPoses(still, moving, mode).failure, AlignmentFailure::kNoExtent);
    EXPECT_EQ(AlignPoses(moving, still, mode).failure, AlignmentFailure::kNoExtent);
  }
  EXPECT_EQ(
      AlignPoses(StraightPath({1, 0, 0}, 5), StraightPath({-1, 0, 0}, 5), AlignmentMode::kScale)
          .failure,
      AlignmentFailure::kScaleNotPositive);
  EXPECT_THROW(AlignPoses(two, moving, AlignmentMode::kSim3), CheckError);
}

TEST(Alignment, OriginMakesTheFirstPosesCoincide) {
  Random random(7);
  const Poses estimate = RandomPath(random, 10);
  const Poses reference = RandomPath(random, 10);
  const Alignment alignment = AlignPoses(estimate, reference, AlignmentMode::kOrigin);
  const Rigid3d first = TransformWorld(estimate[0], *alignment.reference_from_estimate);
  const Rigid3d difference = Inverse(reference[0]) * first;
  EXPECT_LT(difference.translation.norm() + RotationAngle(difference.rotation), 1e-12);
}

TEST(Alignment, ScaleMeasuresFromTheFirstPoses) {
  Random random(8);
  const Poses estimate = RandomPath(random, 50);
  const Poses reference =
      Transformed(estimate, Sim3d(0.25, RandomRotation(random), RandomVector(random)));
  const Alignment alignment = AlignPoses(estimate, reference, AlignmentMode::kScale);
  EXPECT_NEAR(alignment.reference_from_estimate->scale, 0.25, 1e-12);
  EXPECT_LT(Rmse(estimate, reference, alignment), 1e-12);
}

TEST(Alignment, ScaleSim3DoesNotMoveThePath) {
  Random random(9);
  const Poses estimate = RandomPath(random, 50);
  const Poses reference =
      Transformed(estimate, Sim3d(4.0, RandomRotation(random), RandomVector(random)));
  const Alignment alignment = AlignPoses(estimate, reference, AlignmentMode::kScaleSim3);
  EXPECT_NEAR(alignment.reference_from_estimate->scale, 4.0, 1e-12);
  EXPECT_EQ(alignment.reference_from_estimate->translation.norm(), 0.0);
  EXPECT_EQ(RotationAngle(alignment.reference_from_estimate->rotation), 0.0);
}

}  // namespace
}  // namespace lift_slam
