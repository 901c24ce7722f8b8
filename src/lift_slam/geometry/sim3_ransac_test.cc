#include "lift_slam/geometry/sim3_ransac.h"

#include <gtest/gtest.h>

#include "lift_slam/geometry/sim3_refinement.h"
#include "lift_slam/testing/sim3_scene.h"

namespace lift_slam {
namespace {

std::vector<Sim3Match> Matches(const Sim3Scene& scene) {
  std::vector<Sim3Match> matches;
  for (const Sim3SceneMatch& match : scene.matches) {
    matches.push_back({match.point_in_cam1, match.point_in_cam2,
                       scene.pinhole.Unproject(match.pixel1).head<2>(),
                       scene.pinhole.Unproject(match.pixel2).head<2>(), 1.0, 1.0});
  }
  return matches;
}

std::optional<Sim3Estimate> Estimate(const Sim3Scene& scene, ScaleFit fit = ScaleFit::kFree) {
  return EstimateSim3(Matches(scene), 500.0, 500.0, fit, {}, 1);
}

void ExpectNear(const Sim3d& estimate, const Sim3d& truth, double scale_ratio, double radians,
                double map_units) {
  EXPECT_NEAR(estimate.scale / truth.scale, 1.0, scale_ratio);
  EXPECT_LT(RotationAngle(estimate.rotation * truth.rotation.conjugate()), radians);
  EXPECT_LT((estimate.translation - truth.translation).norm(), map_units);
}

TEST(EstimateSim3, ExactMatchesGiveTheExactSimilarity) {
  for (const double scale : {0.1, 1.0, 7.0}) {
    const Sim3Scene scene = MakeSim3Scene({.noise_px = 0.0, .scale = scale});
    const auto estimate = Estimate(scene);
    ASSERT_TRUE(estimate);
    ExpectNear(estimate->cam1_from_cam2, scene.cam1_from_cam2, 1e-9, 1e-9, 1e-8);
    EXPECT_EQ(estimate->num_inliers, 200);
  }
}

TEST(EstimateSim3, ToleratesSixtyPercentOutliersAndMarksThem) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Sim3Scene scene =
        MakeSim3Scene({.depth_noise = 0.01, .outlier_ratio = 0.6, .seed = seed});
    const auto estimate = Estimate(scene);
    ASSERT_TRUE(estimate) << seed;
    ExpectNear(estimate->cam1_from_cam2, scene.cam1_from_cam2, 0.01, 0.002, 0.1);
    int wrong_inliers = 0, right_inliers = 0, num_right = 0;
    for (std::size_t i = 0; i < scene.matches.size(); ++i) {
      num_right += !scene.matches[i].is_outlier;
      (scene.matches[i].is_outlier ? wrong_inliers : right_inliers) += estimate->is_inlier[i];
    }
    EXPECT_LE(wrong_inliers, 2);
    EXPECT_GE(right_inliers, 0.8 * num_right);
    EXPECT_EQ(wrong_inliers + right_inliers, estimate->num_inliers);
  }
}

TEST(EstimateSim3, FixedScaleStaysOneAndRefusesOthers) {
  const auto fixed =
      Estimate(MakeSim3Scene({.outlier_ratio = 0.3, .scale = 1.0}), ScaleFit::kFixed);
  ASSERT_TRUE(fixed);
  EXPECT_EQ(fixed->cam1_from_cam2.scale, 1.0);
  EXPECT_GE(fixed->num_inliers, 120);
  EXPECT_FALSE(Estimate(MakeSim3Scene({.scale = 2.5}), ScaleFit::kFixed));
}

TEST(RefineSim3, FindsTheExactSimilarityFromNearby) {
  const Sim3Scene scene = MakeSim3Scene({.noise_px = 0.0});
  const Sim3d near =
      Sim3d(1.1, Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX())),
            {0.1, 0.2, -0.3}) *
      scene.cam1_from_cam2;
  const Sim3d refined = RefineSim3(Matches(scene), 500.0, 500.0, near, ScaleFit::kFree, 1e6, 20);
  ExpectNear(refined, scene.cam1_from_cam2, 1e-8, 1e-8, 1e-7);
  const Sim3d fixed = RefineSim3(Matches(scene), 500.0, 500.0, near, ScaleFit::kFixed, 1e6, 20);
  EXPECT_DOUBLE_EQ(fixed.scale, near.scale);
}

TEST(EstimateSim3, SameSeedSameBits) {
  const Sim3Scene scene = MakeSim3Scene({.outlier_ratio = 0.5});
  const auto first = Estimate(scene), second = Estimate(scene);
  EXPECT_EQ(first->cam1_from_cam2.translation, second->cam1_from_cam2.translation);
  EXPECT_EQ(first->is_inlier, second->is_inlier);
}

TEST(EstimateSim3, NothingFromWrongOrFewMatches) {
  EXPECT_FALSE(Estimate(MakeSim3Scene({.outlier_ratio = 1.0})));
  EXPECT_FALSE(Estimate(MakeSim3Scene({.num_matches = 19})));
  EXPECT_FALSE(EstimateSim3({}, 500.0, 500.0, ScaleFit::kFree, {}, 1));
}

TEST(EstimateSim3, SurvivesEqualPointsAndPointsBehind) {
  Sim3Match match{{1, 2, 5}, {1, 2, 5}, {0.2, 0.4}, {0.2, 0.4}};
  EXPECT_FALSE(
      EstimateSim3(std::vector<Sim3Match>(50, match), 500.0, 500.0, ScaleFit::kFree, {}, 1));
  std::vector<Sim3Match> behind = Matches(MakeSim3Scene({}));
  for (Sim3Match& m : behind) m.point_in_cam2 = -m.point_in_cam2;
  EXPECT_FALSE(EstimateSim3(behind, 500.0, 500.0, ScaleFit::kFree, {}, 1));
}

}  // namespace
}  // namespace lift_slam
