#include <gtest/gtest.h>

#include <numbers>

#include "lift_slam/matching/epipolar_matcher.h"
#include "lift_slam/matching/feature_matcher.h"
#include "lift_slam/matching/frame_matcher.h"
#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/point_fusion.h"
#include "lift_slam/matching/point_projection.h"
#include "lift_slam/matching/rotation_consistency.h"
#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

constexpr int kPoints = 120;

// Points before two cameras a step apart; feature i of each frame sees point i.
class MatchingTest : public testing::Test {
 protected:
  Frame MakeFrame(std::int64_t index, const Rigid3d& cam_from_world) {
    return scene_.MakeFrame(index, cam_from_world);
  }

  static Rigid3d Step(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, -0.05}}; }

  // Two keyframes that see all points.
  void FillMap() {
    ids_ = scene_.FillMap({Rigid3d(), Step(0.3)}, *map_);
    first_ = map_->KeyFrameIds().front();
    second_ = map_->newest_keyframe();
  }

  int CountRight(const Frame& frame) const {
    int right = 0;
    for (std::size_t i = 0; i < ids_.size(); ++i) right += frame.map_points[i] == ids_[i] ? 1 : 0;
    return right;
  }

  SyntheticFrames scene_{kPoints, 3.0, 8.0, 11};
  std::shared_ptr<const ViewModel> view_ = scene_.view();
  std::vector<Eigen::Vector3d> points_ = scene_.points();
  std::unique_ptr<Map> map_ = std::make_unique<Map>(view_);
  KeyFrameId first_, second_;
  std::vector<MapPointId> ids_;
};

TEST_F(MatchingTest, WindowMatchesAreRightAndMutual) {
  const Frame a = MakeFrame(0, Rigid3d()), b = MakeFrame(1, Step(0.3));
  std::vector<Eigen::Vector2f> expected;
  for (int i = 0; i < kPoints; ++i) expected.push_back(a.features->undistorted(i));
  const auto matches = MatchWithinWindow(*a.features, *b.features, expected, 60.0F, *view_);
  EXPECT_GT(matches.size(), 100U);
  for (const FeatureMatch& match : matches) EXPECT_EQ(match.a, match.b);
}

TEST_F(MatchingTest, EpipolarMatchesAreRightWithinTheDepthRange) {
  const KeyFrameId a = map_->AddKeyFrame(MakeFrame(0, Rigid3d()));
  const KeyFrameId b = map_->AddKeyFrame(MakeFrame(1, Step(0.3)));
  const auto matches =
      MatchAlongEpipolarLines(map_->keyframe(a), map_->keyframe(b), 2.0, 50.0F, *view_, {});
  EXPECT_GT(matches.size(), 100U);
  for (const FeatureMatch& match : matches) EXPECT_EQ(match.a, match.b);
  // With a least depth behind all points, only features in the cells of a segment come along.
  const auto none =
      MatchAlongEpipolarLines(map_->keyframe(a), map_->keyframe(b), 60.0, 50.0F, *view_, {});
  EXPECT_LT(none.size(), kPoints / 4U);
}

TEST_F(MatchingTest, EpipolarMatchingLeavesFeaturesWithPointsAlone) {
  FillMap();
  EXPECT_TRUE(MatchAlongEpipolarLines(map_->keyframe(first_), map_->keyframe(second_), 2.0, 50.0F,
                                      *view_, {})
                  .empty());
}

TEST_F(MatchingTest, LastFrameAndLocalPointsMatchesAreRight) {
  FillMap();
  Frame last = MakeFrame(1, Step(0.3));
  last.map_points = map_->keyframe(second_).map_points;
  Frame frame = MakeFrame(2, Step(0.45));
  const int matches = MatchFromLastFrame(*map_, last, 15.0F, 100.0F, frame);
  EXPECT_GT(matches, 100);
  EXPECT_EQ(CountRight(frame), matches);

  Frame fresh = MakeFrame(3, Step(0.45));
  const LocalMatchResult local = MatchLocalPoints(*map_, ids_, 1.0F, 100.0F, fresh);
  EXPECT_GT(local.num_matches, 100);
  EXPECT_EQ(CountRight(fresh), local.num_matches);
  EXPECT_GE(static_cast<int>(local.visible.size()), local.num_matches);
}

TEST_F(MatchingTest, KeyFrameMatchesNeedNoPrediction) {
  FillMap();
  Frame frame = MakeFrame(2, Step(0.4));
  frame.cam_from_world = Rigid3d(Eigen::Quaterniond::Identity(), {50.0, 0.0, 0.0});
  const int matches = MatchFromKeyFrame(*map_, map_->keyframe(second_), 50.0F, frame);
  EXPECT_GT(matches, 100);
  EXPECT_EQ(CountRight(frame), matches);
}

TEST_F(MatchingTest, FusionAddsObservationsAndMergesDuplicates) {
  FillMap();
  const KeyFrameId third = map_->AddKeyFrame(MakeFrame(2, Step(0.4)));
  const FusionCounts added = FusePoints(ids_, third, 3.0F, 50.0F, *map_);
  EXPECT_GT(added.observations_added, 100);
  EXPECT_EQ(added.points_merged, 0);

  // The same points once more, seen by two other keyframes.
  const KeyFrameId fourth = map_->AddKeyFrame(MakeFrame(3, Step(0.5)));
  const KeyFrameId fifth = map_->AddKeyFrame(MakeFrame(4, Step(0.6)));
  for (int i = 0; i < kPoints; ++i) {
    const MapPointId id = map_->AddPoint(points_[static_cast<std::size_t>(i)], fifth);
    map_->AddObservation(id, fourth, i);
    map_->AddObservation(id, fifth, i);
    map_->UpdateAppearance(id);
  }
  const int before = map_->num_points();
  const FusionCounts merged = FusePoints(ids_, fifth, 3.0F, 50.0F, *map_);
  EXPECT_GT(merged.points_merged, 100);
  EXPECT_EQ(map_->num_points(), before - merged.points_merged);
}

TEST_F(MatchingTest, ProjectionRefusesWhatCannotBeSeen) {
  FillMap();
  const MapPoint& point = map_->point(ids_[0]);
  EXPECT_TRUE(ProjectPoint(*view_, point, Rigid3d()).has_value());
  const Rigid3d behind(Eigen::Quaterniond::Identity(), {0.0, 0.0, -20.0});
  EXPECT_FALSE(ProjectPoint(*view_, point, behind).has_value());
  const Rigid3d far(Eigen::Quaterniond::Identity(), {0.0, 0.0, 200.0});
  EXPECT_FALSE(ProjectPoint(*view_, point, far).has_value());
  const Rigid3d aside(Eigen::Quaterniond::Identity(), {30.0, 0.0, 0.0});
  EXPECT_FALSE(ProjectPoint(*view_, point, aside).has_value());
}

TEST(RotationConsistency, DropsMatchesThatTurnAgainstTheRest) {
  RotationConsistency rotation;
  for (int i = 0; i < 50; ++i) rotation.Add(0.5F, 0.2F, i);
  rotation.Add(2.9F, 0.1F, 50);
  EXPECT_EQ(rotation.Outliers(), (std::vector<int>{50}));
}

TEST(RotationConsistency, AnglesAroundPiAreOneDirection) {
  RotationConsistency rotation;
  const auto pi = static_cast<float>(std::numbers::pi);
  for (int i = 0; i < 50; ++i) rotation.Add(pi - 0.01F, -pi + 0.01F, i);
  EXPECT_TRUE(rotation.Outliers().empty());
}

TEST(NearestTwo, FirstOfEqualsWinsAndSecondIsKept) {
  NearestTwo nearest;
  nearest.Offer(4, 10.0F);
  nearest.Offer(5, 10.0F);
  nearest.Offer(6, 30.0F);
  EXPECT_EQ(nearest.best, 4);
  EXPECT_EQ(nearest.second, 5);
  EXPECT_FALSE(nearest.IsDistinctive(0.9F));
}

}  // namespace
}  // namespace lift_slam
