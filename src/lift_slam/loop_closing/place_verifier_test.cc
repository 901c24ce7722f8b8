#include "lift_slam/loop_closing/place_verifier.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/loop_closing/loop_closer.h"
#include "lift_slam/loop_closing/vocabulary_for_test.h"
#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

constexpr double kScale = 2.5;  // of the second map's units

Rigid3d CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, -0.02}}; }

// Two maps of one scene, with units of their own, and one of another scene.
class PlaceVerifierTest : public testing::Test {
 protected:
  PlaceVerifierTest() {
    scene_.FillMap({CameraAt(0.0), CameraAt(0.1), CameraAt(0.2)}, first_);
    FillScaled({CameraAt(0.5), CameraAt(0.6), CameraAt(0.7)}, scene_, second_);
    FillScaled({CameraAt(0.5), CameraAt(0.6), CameraAt(0.7)}, elsewhere_, third_);
    vocabulary_ =
        VocabularyOf({scene_.MakeFrame(0, CameraAt(0.3)), scene_.MakeFrame(1, CameraAt(0.4)),
                      elsewhere_.MakeFrame(2, CameraAt(0.3))});
    for (auto [map, closer] : {std::pair{&first_, &first_closer_},
                               {&second_, &second_closer_},
                               {&third_, &third_closer_}}) {
      closer->emplace(options_, vocabulary_, 1);
      (*closer)->Update(*map);
    }
  }

  static void FillScaled(const std::vector<Rigid3d>& poses, SyntheticFrames& scene, Map& map) {
    scene.FillMap(poses, map);
    for (const MapPointId id : map.PointIds()) map.point(id).position *= kScale;
    for (const KeyFrameId id : map.KeyFrameIds()) {
      Rigid3d pose = map.keyframe(id).cam_from_world;
      pose.translation *= kScale;
      map.SetPose(id, pose);
    }
    for (const MapPointId id : map.PointIds()) map.UpdateAppearance(id);
  }

  LoopReport Find(const Map& map, const LoopCloser& closer) const {
    return closer.FindInOtherMap(KeyFrameId(2), map, first_, *first_closer_);
  }

  PlaceIndex IndexOf(const Map& map) const {
    PlaceIndex places(vocabulary_, options_.score);
    for (const KeyFrameId id : map.KeyFrameIds()) places.Add(map.keyframe(id));
    return places;
  }

  // The newest keyframe of one map with the middle one of another.
  PlaceMatch Verify(const Map& query, const Map& other) const {
    const PlaceIndex query_index = IndexOf(query), index = IndexOf(other);
    return VerifyPlace({query, query_index, KeyFrameId(2)}, {other, index, KeyFrameId(1)},
                       options_.verification, 1);
  }

  LoopClosingOptions options_;
  SyntheticFrames scene_{300, 4.0, 8.0, 5}, elsewhere_{300, 4.0, 8.0, 77};
  Map first_{scene_.view()}, second_{scene_.view()}, third_{elsewhere_.view()};
  std::shared_ptr<const Vocabulary> vocabulary_;
  std::optional<LoopCloser> first_closer_, second_closer_, third_closer_;
};

TEST_F(PlaceVerifierTest, SamePlaceGivesTheSimilarityBetweenTheMaps) {
  const LoopReport report = Find(second_, *second_closer_);
  ASSERT_FALSE(report.attempts.empty());
  const PlaceMatch& match = report.attempts.back().match;
  ASSERT_EQ(match.rejection, PlaceRejection::kAccepted) << Explain(match.rejection);
  EXPECT_NEAR(match.query_from_candidate_world.scale, kScale, 0.01);
  EXPECT_GE(match.num_projected, 200);
  EXPECT_EQ(match.num_confirming, 2);
  // Point ids of both maps count in the order of the scene's points.
  for (std::size_t i = 0; i < match.points.size(); ++i) {
    if (match.points[i].valid()) {
      EXPECT_EQ(match.points[i].index(), i);
    }
  }
}

TEST_F(PlaceVerifierTest, AWallThatStandsElsewhereTooIsNotThePlace) {
  // The first 120 points of the scene: seen from either side one of both shares is whole.
  SyntheticFrames wall(120, 4.0, 8.0, 5);
  Map walled{wall.view()};
  wall.FillMap({CameraAt(0.0), CameraAt(0.1), CameraAt(0.2)}, walled);
  const PlaceMatch has_less = Verify(second_, walled);
  EXPECT_EQ(has_less.rejection, PlaceRejection::kFewFound) << Name(has_less.rejection);
  EXPECT_NEAR(has_less.found_ratio, 1.0, 0.05);
  EXPECT_NEAR(has_less.mutual_ratio, std::sqrt(120.0 / 300.0), 0.05);
  const PlaceMatch has_more = Verify(walled, second_);
  EXPECT_EQ(has_more.rejection, PlaceRejection::kFewFound) << Name(has_more.rejection);
  EXPECT_NEAR(has_more.mutual_ratio, std::sqrt(120.0 / 300.0), 0.05);
  EXPECT_NEAR(Verify(second_, first_).mutual_ratio, 1.0, 0.05);
}

TEST_F(PlaceVerifierTest, AnotherPlaceIsRefusedWithTheReason) {
  const PlaceMatch match = Verify(third_, first_);
  EXPECT_EQ(match.rejection, PlaceRejection::kFewWordMatches);
  for (const PlaceAttempt& attempt : Find(third_, *third_closer_).attempts) {
    EXPECT_NE(attempt.match.rejection, PlaceRejection::kAccepted);
  }
}

TEST_F(PlaceVerifierTest, AMapWhosePointsAreInAnotherShapeIsRefused) {
  // The same looks in places that do not fit: no similarity explains them.
  Random random(3);  // a hundredth to a hundred times as far: hardly any two agree
  const Eigen::Vector3d center = second_.keyframe(KeyFrameId(2)).Center();
  for (const MapPointId id : second_.PointIds()) {
    MapPoint& point = second_.point(id);
    const double factor = std::pow(10.0, random.Uniform(-2.0, 2.0));
    point.position = center + factor * (point.position - center);
  }
  const LoopReport report = Find(second_, *second_closer_);
  ASSERT_FALSE(report.attempts.empty());
  EXPECT_NE(report.attempts.back().match.rejection, PlaceRejection::kAccepted);
}

TEST_F(PlaceVerifierTest, ALostFrameLooksLikeTheKeyFramesOfItsPlace) {
  const Frame lost = scene_.MakeFrame(9, CameraAt(0.15));
  EXPECT_FALSE(first_closer_->FindSimilar(*lost.features, first_).empty());
}

}  // namespace
}  // namespace lift_slam
