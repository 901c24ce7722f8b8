#include "lift_slam/geometry/two_view_reconstruction.h"

#include <gtest/gtest.h>

#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/testing/rigid3_matchers.h"
#include "lift_slam/testing/synthetic_scene.h"

namespace lift_slam {
namespace {

struct Pair {
  SyntheticScene scene;
  std::vector<SyntheticMatch> source;
  std::vector<TwoViewMatch> matches;
};

Pair MakePair(const Rigid3d& cam2_from_cam1, const SyntheticSceneOptions& options) {
  Pair pair;
  pair.scene = MakeSyntheticScene({Rigid3d(), cam2_from_cam1}, options);
  pair.source = MatchesBetween(pair.scene, 0, 1);
  for (const SyntheticMatch& match : pair.source) {
    pair.matches.push_back({pair.scene.pinhole.Unproject(match.pixel1).head<2>(),
                            pair.scene.pinhole.Unproject(match.pixel2).head<2>(), 1.0});
  }
  return pair;
}

TwoViewReconstruction Reconstruct(const Pair& pair, std::uint64_t seed = 1) {
  return ReconstructTwoViews(pair.matches, pair.scene.pinhole.fx, TwoViewOptions{}, seed);
}

Rigid3d Motion(double turn_deg, const Eigen::Vector3d& translation) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.2, 1.0, 0.1).normalized();
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn_deg * 0.017453292519943295, axis)),
          translation};
}

Rigid3d WithUnitBaseline(const Rigid3d& pose) {
  return {pose.rotation, pose.translation.normalized()};
}

TEST(TwoViewReconstruction, SidewaysMotionInAVolume) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.1;
  const Rigid3d motion = Motion(3.0, {-0.6, 0.05, 0.1});
  const Pair pair = MakePair(motion, options);
  const TwoViewReconstruction result = Reconstruct(pair);
  ASSERT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
  EXPECT_THAT(result.cam2_from_cam1, Rigid3dNear(WithUnitBaseline(motion), 0.15, 0.04));
  int agree = 0;
  for (std::size_t i = 0; i < pair.source.size(); ++i) {
    agree += (result.is_inlier[i] != 0) != pair.source[i].is_outlier ? 1 : 0;
  }
  EXPECT_GT(agree, 0.93 * static_cast<double>(pair.source.size()));
}

TEST(TwoViewReconstruction, PointsAreInTheFrameOfCamera1AtUnitBaseline) {
  SyntheticSceneOptions options;
  options.noise_px = 0.1;
  options.max_depth = 8.0;
  const Rigid3d motion = Motion(3.0, {-0.6, 0.05, 0.1});
  const Pair pair = MakePair(motion, options);
  const TwoViewReconstruction result = Reconstruct(pair);
  ASSERT_EQ(result.status, TwoViewStatus::kSuccess);
  int checked = 0;
  for (std::size_t i = 0; i < pair.source.size(); ++i) {
    if (!result.points[i]) continue;
    const auto& truth = pair.scene.points[static_cast<std::size_t>(pair.source[i].point)];
    EXPECT_LT((*result.points[i] * motion.translation.norm() - truth).norm(), 0.05 * truth.norm());
    EXPECT_GT(result.parallax_deg[i], 0.0F);
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST(TwoViewReconstruction, ForwardMotionAsFromACar) {
  SyntheticSceneOptions options;
  options.noise_px = 0.3;
  options.outlier_ratio = 0.05;
  options.max_depth = 60.0;
  const Rigid3d motion = Motion(1.0, {0.0, 0.0, -1.0});
  const TwoViewReconstruction result = Reconstruct(MakePair(motion, options));
  ASSERT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
  EXPECT_THAT(result.cam2_from_cam1, Rigid3dNear(motion, 0.1, 0.05));
}

TEST(TwoViewReconstruction, PlaneWithSomeObjectsBeforeIt) {
  SyntheticSceneOptions options;
  options.shape = SyntheticShape::kPlane;
  options.min_depth = options.max_depth = 2.0;
  options.noise_px = 0.3;
  const Rigid3d motion = Motion(2.0, {-0.25, 0.05, 0.05});
  Pair pair = MakePair(motion, options);
  options.shape = SyntheticShape::kVolume;
  options.min_depth = 1.2;
  options.num_points = 60;
  const Pair objects = MakePair(motion, options);
  pair.matches.insert(pair.matches.end(), objects.matches.begin(), objects.matches.end());
  const TwoViewReconstruction result = Reconstruct(pair);
  ASSERT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
  EXPECT_THAT(result.cam2_from_cam1, Rigid3dNear(WithUnitBaseline(motion), 0.4, 0.06));
}

TEST(TwoViewReconstruction, NearPlaneAloneIsSolvedRightOrRefusedAsAmbiguous) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SyntheticSceneOptions options;
    options.shape = SyntheticShape::kPlane;
    options.min_depth = options.max_depth = 2.0;
    options.noise_px = 0.3;
    options.seed = seed;
    const Rigid3d motion = Motion(2.0, {-0.3, 0.1, -0.15});
    const TwoViewReconstruction result = Reconstruct(MakePair(motion, options), seed);
    if (result.status == TwoViewStatus::kAmbiguousPlanar) continue;
    ASSERT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
    EXPECT_THAT(result.cam2_from_cam1, Rigid3dNear(WithUnitBaseline(motion), 1.0, 0.1));
    ++solved;
  }
  RecordProperty("solved", solved);
}

TEST(TwoViewReconstruction, RefusesTwoEquallyGoodPlanarPoses) {
  // A distant patch of the plane: both poses of its homography put every point in front.
  SyntheticSceneOptions options;
  options.shape = SyntheticShape::kPlane;
  options.min_depth = options.max_depth = 2.0;
  options.noise_px = 1.0;
  const Rigid3d motion = Motion(0.0, {-0.06, 0.0, 0.0});
  const TwoViewReconstruction result = Reconstruct(MakePair(motion, options));
  EXPECT_EQ(result.status, TwoViewStatus::kAmbiguousPlanar) << Name(result.status);
  EXPECT_GT(result.runner_up_score, 0.95 * result.score);
}

TEST(TwoViewReconstruction, RefusesPureRotation) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SyntheticSceneOptions options;
    options.outlier_ratio = 0.1;
    options.seed = seed;
    const TwoViewReconstruction result =
        Reconstruct(MakePair(Motion(6.0, {0.0, 0.0, 0.0}), options), seed);
    EXPECT_EQ(result.status, TwoViewStatus::kPureRotation) << Name(result.status);
    EXPECT_NEAR(result.rotation_deg, 6.0, 0.1);
  }
}

TEST(TwoViewReconstruction, RefusesAStillCamera) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SyntheticSceneOptions options;
    options.seed = seed;
    const TwoViewReconstruction result =
        Reconstruct(MakePair(Motion(0.0, {-0.005, 0.0, 0.002}), options), seed);
    EXPECT_EQ(result.status, TwoViewStatus::kLowParallax) << Name(result.status);
  }
}

TEST(TwoViewReconstruction, RefusesAStillCameraThatSeesAMovingObject) {
  SyntheticSceneOptions options;
  options.num_points = 400;
  Pair pair = MakePair(Motion(0.0, Eigen::Vector3d::Zero()), options);
  options.num_points = 100;
  options.min_depth = 5.0;
  options.max_depth = 6.0;
  const Pair mover = MakePair(Motion(0.0, {-0.5, 0.0, 0.3}), options);
  pair.matches.insert(pair.matches.end(), mover.matches.begin(), mover.matches.end());
  EXPECT_NE(Reconstruct(pair).status, TwoViewStatus::kSuccess);
}

TEST(TwoViewReconstruction, RefusesFewMatchesAndWrongMatches) {
  SyntheticSceneOptions options;
  Pair pair = MakePair(Motion(3.0, {-0.6, 0.0, 0.0}), options);
  pair.matches.resize(30);
  EXPECT_EQ(Reconstruct(pair).status, TwoViewStatus::kTooFewMatches);
  options.outlier_ratio = 0.9;
  const TwoViewReconstruction wrong = Reconstruct(MakePair(Motion(3.0, {-0.6, 0, 0}), options));
  EXPECT_EQ(wrong.status, TwoViewStatus::kTooFewPoints) << Name(wrong.status);
  EXPECT_EQ(ReconstructTwoViews({}, 500.0, {}, 1).status, TwoViewStatus::kTooFewMatches);
}

TEST(TwoViewReconstruction, IdenticalMatchesDoNotBreakIt) {
  const std::vector<TwoViewMatch> matches(200, {{0.1, 0.2}, {0.1, 0.2}, 1.0});
  EXPECT_NE(ReconstructTwoViews(matches, 500.0, {}, 1).status, TwoViewStatus::kSuccess);
}

TEST(TwoViewReconstruction, SameSeedSameResult) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.2;
  const Pair pair = MakePair(Motion(3.0, {-0.6, 0.05, 0.1}), options);
  const TwoViewReconstruction a = Reconstruct(pair, 7), b = Reconstruct(pair, 7);
  EXPECT_EQ(a.cam2_from_cam1.rotation.coeffs(), b.cam2_from_cam1.rotation.coeffs());
  EXPECT_EQ(a.cam2_from_cam1.translation, b.cam2_from_cam1.translation);
  EXPECT_EQ(a.is_inlier, b.is_inlier);
}

}  // namespace
}  // namespace lift_slam
