#include "lift_slam/geometry/two_view_models.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "lift_slam/geometry/epipolar.h"
#include "lift_slam/geometry/homography.h"
#include "lift_slam/testing/rigid3_matchers.h"
#include "lift_slam/testing/synthetic_scene.h"

namespace lift_slam {
namespace {

const Rigid3d kCam2FromCam1(
    Eigen::Quaterniond(Eigen::AngleAxisd(0.08, Eigen::Vector3d(0.3, 1.0, -0.2).normalized())),
    Eigen::Vector3d(-0.8, 0.1, -0.3).normalized());

std::vector<NormalizedMatch> Matches(const Rigid3d& cam2_from_cam1,
                                     const SyntheticSceneOptions& options) {
  const SyntheticScene scene = MakeSyntheticScene({Rigid3d(), cam2_from_cam1}, options);
  std::vector<NormalizedMatch> matches;
  for (const SyntheticMatch& match : MatchesBetween(scene, 0, 1)) {
    matches.push_back({scene.pinhole.Unproject(match.pixel1).head<2>(),
                       scene.pinhole.Unproject(match.pixel2).head<2>(),
                       std::max(options.noise_px, 0.01) / scene.pinhole.fx});
  }
  return matches;
}

SyntheticSceneOptions Exact() {
  SyntheticSceneOptions options;
  options.noise_px = 0.0;
  return options;
}

double DistanceToClosest(const std::vector<Eigen::Matrix3d>& candidates,
                         const Eigen::Matrix3d& expected) {
  const Eigen::Matrix3d unit = expected.normalized();
  double closest = 10.0;
  for (const Eigen::Matrix3d& candidate : candidates) {
    closest = std::min({closest, (candidate - unit).norm(), (candidate + unit).norm()});
  }
  return closest;
}

TEST(Epipolar, ErrorIsTheDistanceInPixels) {
  const Rigid3d sideways(Eigen::Quaterniond::Identity(), {-1.0, 0.0, 0.0});
  const Eigen::Matrix3d essential = EssentialMatrix(sideways);
  const Eigen::Vector2d in1(0.1, 0.2), in2(0.05, 0.23);  // off the row by 0.03
  EXPECT_NEAR(SquaredDistanceToLine(EpipolarLine(essential, in1), in2), 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(SquaredSampsonError(essential, in1, in2), 0.03 * 0.03 / 2, 1e-12);
}

TEST(FivePoint, FindsTheEssentialMatrixOfExactMatches) {
  const auto matches = Matches(kCam2FromCam1, Exact());
  for (std::size_t i = 0; i + 5 < 100; i += 5) {
    std::array<const NormalizedMatch*, 5> sample{};
    for (std::size_t k = 0; k < 5; ++k) sample[k] = &matches[i + k];
    EXPECT_LT(DistanceToClosest(SolveFivePoint(sample), EssentialMatrix(kCam2FromCam1)), 1e-5);
  }
}

TEST(FivePoint, WorksOnAPlaneAndForForwardMotion) {
  SyntheticSceneOptions plane = Exact();
  plane.shape = SyntheticShape::kPlane;
  const Rigid3d forward(Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.0});
  for (const auto& [pose, options] :
       {std::pair{kCam2FromCam1, plane}, std::pair{forward, Exact()}}) {
    const auto matches = Matches(pose, options);
    const std::array<const NormalizedMatch*, 5> sample{&matches[0], &matches[1], &matches[2],
                                                       &matches[3], &matches[4]};
    EXPECT_LT(DistanceToClosest(SolveFivePoint(sample), EssentialMatrix(pose)), 1e-5);
  }
}

TEST(EssentialMatrix, OneOfTheFourDecompositionsIsThePose) {
  const auto poses = DecomposeEssential(EssentialMatrix(kCam2FromCam1));
  EXPECT_THAT(poses, testing::Contains(Rigid3dNear(kCam2FromCam1, 1e-6, 1e-8)));
  for (const Rigid3d& pose : poses) EXPECT_NEAR(pose.translation.norm(), 1.0, 1e-12);
}

TEST(RefineRelativePose, ConvergesToTheExactPose) {
  const auto matches = Matches(kCam2FromCam1, Exact());
  const Eigen::Quaterniond off(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()));
  const Rigid3d start(off * kCam2FromCam1.rotation,
                      kCam2FromCam1.translation + Eigen::Vector3d(0.05, 0.1, 0.1));
  EXPECT_THAT(RefineRelativePose(matches, start, 1e12, 30), Rigid3dNear(kCam2FromCam1, 1e-5, 1e-6));
}

TEST(RefineRelativePose, ReducesTheErrorOfNoisyMatches) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.1;
  const auto matches = Matches(kCam2FromCam1, options);
  const Eigen::Quaterniond off(Eigen::AngleAxisd(0.001, Eigen::Vector3d::UnitX()));
  const Rigid3d start(off * kCam2FromCam1.rotation,
                      kCam2FromCam1.translation + Eigen::Vector3d(0.0, 0.03, 0.02));
  EXPECT_THAT(RefineRelativePose(matches, start, 9.0, 20), Rigid3dNear(kCam2FromCam1, 0.1, 0.015));
}

TEST(Homography, FitsAPlaneAndDecomposesIntoItsPose) {
  SyntheticSceneOptions plane = Exact();
  plane.shape = SyntheticShape::kPlane;
  const auto matches = Matches(kCam2FromCam1, plane);
  for (const std::size_t count : {std::size_t{4}, matches.size()}) {
    const auto homography = FitHomography(std::span(matches).first(count));
    ASSERT_TRUE(homography);
    const Eigen::Matrix3d inverse = homography->inverse();
    for (const NormalizedMatch& match : matches) {
      EXPECT_LT(SquaredHomographyError(*homography, inverse, match), 1e-6);
    }
    EXPECT_THAT(DecomposeHomography(*homography),
                testing::Contains(Rigid3dNear(kCam2FromCam1, 1e-4, 1e-5)));
  }
}

TEST(Homography, RefusesPointsOnALine) {
  std::vector<NormalizedMatch> matches;
  for (const double x : {0.0, 0.1, 0.2, 0.3}) matches.push_back({{x, x}, {x + 0.1, x}, 1e-3});
  EXPECT_FALSE(FitHomography(matches));
  EXPECT_FALSE(FitHomography(std::span(matches).first(3)));
}

TEST(Rotation, IsFoundAmongOutliers) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.2;
  const Rigid3d turn(kCam2FromCam1.rotation, Eigen::Vector3d::Zero());
  const auto matches = Matches(turn, options);
  Random random(1);
  const TwoViewModel found = FindRotation(matches, {10, 50, 0.999}, random);
  EXPECT_THAT(Rigid3d(found.matrix, Eigen::Vector3d::Zero()), Rigid3dNear(turn, 0.05, 0.0));
  EXPECT_GT(found.inliers, static_cast<int>(0.55 * static_cast<double>(matches.size())));
}

TEST(FindEssentialMatrices, FirstIsTheBestAndAllDiffer) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.15;
  const auto matches = Matches(kCam2FromCam1, options);
  Random random(1);
  const auto found = FindEssentialMatrices(matches, {30, 300, 0.999}, 5, random);
  ASSERT_GE(found.size(), 2U);
  EXPECT_LT(DistanceToClosest({found[0].matrix}, EssentialMatrix(kCam2FromCam1)), 0.05);
  EXPECT_GE(found[0].score, found[1].score);
  EXPECT_GE(DistanceToClosest({found[0].matrix}, found[1].matrix), 0.1);
}

TEST(FindEssentialMatrices, ReturnsNothingForFewerThanFiveMatches) {
  auto matches = Matches(kCam2FromCam1, Exact());
  matches.resize(4);
  Random random(1);
  EXPECT_TRUE(FindEssentialMatrices(matches, {}, 5, random).empty());
}

}  // namespace
}  // namespace lift_slam
