#include <gtest/gtest.h>

#include "lift_slam/testing/rigid3_matchers.h"
#include "lift_slam/testing/synthetic_frames.h"
#include "lift_slam/tracking/backward_tracker.h"
#include "lift_slam/tracking/keyframe_decision.h"
#include "lift_slam/tracking/local_map.h"
#include "lift_slam/tracking/map_initializer.h"
#include "lift_slam/tracking/tracker.h"
#include "lift_slam/tracking/tracking_state.h"

namespace lift_slam {
namespace {

constexpr int kPoints = 300;

Rigid3d CameraAt(double x, double z = 0.0, double yaw_rad = 0.0) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()));
  return {turn, -(turn * Eigen::Vector3d(x, 0.0, z))};
}

class TrackingTest : public testing::Test {
 protected:
  // Fills the map with keyframes at x = 0 and here; the last frame was the second of them.
  Tracker StartedAt(double x, const TrackerOptions& options = {}) {
    points_ = scene_.FillMap({CameraAt(0.0), CameraAt(x)}, map_);
    Frame last = scene_.MakeFrame(1, CameraAt(x));
    last.map_points = map_.keyframe(map_.newest_keyframe()).map_points;
    Tracker tracker(options, MatchingOptions(), 0);
    tracker.Start(map_, last, std::nullopt);
    return tracker;
  }

  SyntheticFrames scene_{kPoints, 3.0, 8.0, 21};
  Map map_{scene_.view()};
  std::vector<MapPointId> points_;
};

TEST_F(TrackingTest, FollowsAMovingCameraFrameByFrame) {
  Tracker tracker = StartedAt(0.2);
  for (int k = 0; k < 10; ++k) {
    const Rigid3d truth = CameraAt(0.22 + 0.02 * k, 0.02 * k, 0.002 * k);
    Frame frame = scene_.MakeFrame(2 + k, truth, 0.3);
    frame.cam_from_world = Rigid3d();
    const TrackingResult result = tracker.Track(map_, frame);
    ASSERT_EQ(result.refusal, FrameRefusal::kNone) << "frame " << k;
    EXPECT_GT(result.num_inliers, kPoints / 2);
    EXPECT_THAT(frame.cam_from_world, Rigid3dNear(truth, 0.1, 0.01));
  }
}

TEST_F(TrackingTest, AJumpIsBridgedByTheReferenceKeyFrame) {
  Tracker tracker = StartedAt(0.2);
  const Rigid3d truth = CameraAt(-0.6, 0.2, 0.25);
  Frame frame = scene_.MakeFrame(2, truth);
  const TrackingResult result = tracker.Track(map_, frame);
  ASSERT_EQ(result.refusal, FrameRefusal::kNone);
  EXPECT_FALSE(result.recovered);
  EXPECT_THAT(frame.cam_from_world, Rigid3dNear(truth, 0.1, 0.01));
}

TEST_F(TrackingTest, NewPointsFollowLooseTrackingOnlyWhereTheFeaturesSaySo) {
  auto view = std::make_shared<ViewModel>(*scene_.view());
  view->thresholds = {{50.0F, 100.0F}, {50.0F, 100.0F}, {65.0F, 115.0F}};
  Map map(view);
  scene_.FillMap({CameraAt(0.0), CameraAt(0.2)}, map);
  Frame last = scene_.MakeFrame(1, CameraAt(0.2));
  last.map_points = map.keyframe(map.newest_keyframe()).map_points;
  MatchingOptions matching;
  matching.few = kPoints;  // Never plenty: loose after the first frame.
  matching.plenty = 2 * kPoints;
  Tracker tracker({}, matching, 0);
  tracker.Start(map, last, std::nullopt);
  TrackingResult result;
  for (int k = 0; k < 3; ++k) {
    Frame frame = scene_.MakeFrame(2 + k, CameraAt(0.2 + 0.01 * k), 0.3);
    result = tracker.Track(map, frame);
    ASSERT_EQ(result.refusal, FrameRefusal::kNone);
  }
  EXPECT_EQ(result.thresholds.low, 65.0F);
  EXPECT_EQ(tracker.MappingThresholds(map).low, 65.0F);
  view->thresholds.moves_new_points = false;
  EXPECT_EQ(tracker.MappingThresholds(map).low, 50.0F);
}

// 25 frames of a steady motion with all points, then one with 25 of them: fewer than tracking needs
// by itself.
FrameRefusal RefusalOfAFrameThatSeesLittle(SyntheticFrames& scene, const TrackerOptions& options,
                                           std::int64_t last_interval_ns) {
  Map map(scene.view());
  const std::vector<MapPointId> points = scene.FillMap({CameraAt(0.0), CameraAt(0.02)}, map);
  Frame last = scene.MakeFrame(1, CameraAt(0.02));
  last.map_points = map.keyframe(map.newest_keyframe()).map_points;
  Tracker tracker(options, MatchingOptions(), 0);
  tracker.Start(map, last, std::nullopt);
  for (int k = 2; k < 27; ++k) {
    Frame frame = scene.MakeFrame(k, CameraAt(0.02 * k), 0.3);
    EXPECT_EQ(tracker.Track(map, frame).refusal, FrameRefusal::kNone);
    last = frame;
  }
  for (std::size_t i = 25; i < points.size(); ++i) map.ErasePoint(points[i]);
  Frame frame = scene.MakeFrame(27, CameraAt(0.02 * 27), 0.3);
  frame.timestamp_ns = last.timestamp_ns + last_interval_ns;
  return tracker.Track(map, frame).refusal;
}

TEST_F(TrackingTest, AFrameThatSeesLittleIsTrackedWhereItIsExpected) {
  constexpr std::int64_t kInterval = 100'000'000;  // that of all frames
  EXPECT_EQ(RefusalOfAFrameThatSeesLittle(scene_, {}, kInterval), FrameRefusal::kNone);
  EXPECT_NE(RefusalOfAFrameThatSeesLittle(scene_, {}, 2 * kInterval), FrameRefusal::kNone);
  TrackerOptions without;
  without.motion_prior.min_match_share = 0.0;
  EXPECT_NE(RefusalOfAFrameThatSeesLittle(scene_, without, kInterval), FrameRefusal::kNone);
}

TEST_F(TrackingTest, AnotherSceneIsRefusedWithAReasonAndLeavesNoMatches) {
  Tracker tracker = StartedAt(0.2);
  SyntheticFrames other(kPoints, 3.0, 8.0, 99);
  Frame frame = other.MakeFrame(2, CameraAt(0.2));
  EXPECT_EQ(tracker.Track(map_, frame).refusal, FrameRefusal::kTooFewTracked);
  EXPECT_EQ(frame.CountMatches(), 0);
  // The old view is found again.
  Frame back = scene_.MakeFrame(3, CameraAt(0.2));
  const TrackingResult recovered = tracker.Track(map_, back);
  EXPECT_EQ(recovered.refusal, FrameRefusal::kNone);
  EXPECT_TRUE(recovered.recovered);
}

int SightingsOf(const Map& map) {
  int count = 0;
  for (const MapPointId id : map.PointIds()) count += map.point(id).num_visible;
  return count;
}

TEST_F(TrackingTest, PointsRememberNothingOfARefusedFrame) {
  TrackerOptions options;
  options.min_inliers = kPoints;  // with what is left below no pose is good enough
  Tracker tracker = StartedAt(0.2, options);
  for (std::size_t i = 100; i < points_.size(); ++i) map_.ErasePoint(points_[i]);
  const int before = SightingsOf(map_);
  Frame frame = scene_.MakeFrame(2, CameraAt(0.2));
  const TrackingResult result = tracker.Track(map_, frame);
  EXPECT_NE(result.refusal, FrameRefusal::kNone);
  EXPECT_GT(result.num_visible, 50);
  EXPECT_EQ(SightingsOf(map_), before);
}

TEST_F(TrackingTest, AfterMissingFramesTheMotionIsThatOfTheTimeSince) {
  Tracker tracker = StartedAt(0.1);
  for (const int k : {2, 3, 10, 11}) {
    Frame frame = scene_.MakeFrame(k, CameraAt(0.1 * k), 0.3);
    const TrackingResult result = tracker.Track(map_, frame);
    ASSERT_EQ(result.refusal, FrameRefusal::kNone) << "frame " << k;
    // Found in the narrow window around the expected places, nearly all that is seen.
    if (k == 2) continue;  // no velocity is known yet
    EXPECT_GT(result.num_last_matches, 9 * result.num_visible / 10) << "frame " << k;
  }
}

TEST_F(TrackingTest, AReferenceThatMovedStillHasItsImage) {
  MapInitializer initializer(scene_.view(), {}, {}, 0);
  const auto pyramid = std::make_shared<const ImagePyramid>(
      BuildPyramid(GrayImage(cv::Mat::zeros(480, 640, CV_8UC1)), {}));
  const auto process = [&](SyntheticFrames& scene, int k, double x) {
    Frame frame = scene.MakeFrame(k, CameraAt(x));
    frame.pyramid = pyramid;
    return initializer.Process(frame);
  };
  SyntheticFrames other(kPoints, 3.0, 8.0, 99);
  process(other, 0, 0.0);
  for (int k = 1; k < 4; ++k) {
    EXPECT_EQ(process(scene_, k, 0.0).refusal, FrameRefusal::kTooFewMatches);
  }
  const auto result = process(scene_, 4, 0.3);
  ASSERT_TRUE(result.initial.has_value());
  EXPECT_EQ(result.initial->map->keyframe(KeyFrameId(0)).pyramid, pyramid);
}

TEST_F(TrackingTest, InitializerRefusesAStillCameraAndStartsOnMotion) {
  MapInitializer initializer(scene_.view(), {}, {}, 0);
  EXPECT_EQ(initializer.Process(scene_.MakeFrame(0, CameraAt(0.0))).refusal,
            FrameRefusal::kFirstFrame);
  for (int k = 1; k < 4; ++k) {
    EXPECT_EQ(initializer.Process(scene_.MakeFrame(k, CameraAt(0.0), 0.2)).refusal,
              FrameRefusal::kLowParallax);
  }
  const auto result = initializer.Process(scene_.MakeFrame(4, CameraAt(0.3), 0.2));
  ASSERT_EQ(result.refusal, FrameRefusal::kNone);
  ASSERT_TRUE(result.initial.has_value());
  const InitialMap& initial = *result.initial;
  EXPECT_EQ(initial.map->num_keyframes(), 2);
  EXPECT_GT(initial.map->num_points(), kPoints / 2);
  EXPECT_EQ(initial.waiting.size(), 4U);
  // The median depth of the first keyframe is the unit of length.
  const std::vector<double> depths = initial.map->SceneDepths(KeyFrameId(0));
  EXPECT_NEAR(depths[depths.size() / 2], 1.0, 1e-9);
  const Eigen::Vector3d direction = initial.current.cam_from_world.TargetOriginInSource();
  EXPECT_GT(direction.normalized().x(), 0.99);
}

TEST_F(TrackingTest, InitializerRefusesAPureRotation) {
  MapInitializer initializer(scene_.view(), {}, {}, 0);
  initializer.Process(scene_.MakeFrame(0, CameraAt(0.0)));
  const FrameRefusal refusal =
      initializer.Process(scene_.MakeFrame(1, CameraAt(0.0, 0.0, 0.1), 0.2)).refusal;
  EXPECT_TRUE(refusal == FrameRefusal::kPureRotation || refusal == FrameRefusal::kLowParallax)
      << Name(refusal);
}

TEST_F(TrackingTest, InitializerNeedsFeatures) {
  SyntheticFrames poor(20, 3.0, 8.0, 5);
  MapInitializer initializer(poor.view(), {}, {}, 0);
  EXPECT_EQ(initializer.Process(poor.MakeFrame(0, CameraAt(0.0))).refusal,
            FrameRefusal::kTooFewFeatures);
}

TEST_F(TrackingTest, FramesBeforeTheMapGetTheirPosesBackwards) {
  MapInitializer initializer(scene_.view(), {}, {}, 0);
  MapInitializer::Result result;
  int frames = 0;
  for (; frames < 30 && !result.initial; ++frames) {
    result = initializer.Process(scene_.MakeFrame(frames, CameraAt(0.03 * frames), 0.2));
  }
  ASSERT_TRUE(result.initial.has_value());
  ASSERT_GT(frames, 2);
  const auto backfilled =
      TrackBackwards(*result.initial->map, result.initial->current, result.initial->waiting, {});
  EXPECT_EQ(static_cast<int>(backfilled.size()), frames - 2);
  const double step =
      result.initial->current.cam_from_world.TargetOriginInSource().x() / (frames - 1);
  for (const BackfilledFrame& frame : backfilled) {
    EXPECT_NEAR(frame.cam_from_reference.TargetOriginInSource().x(),
                step * static_cast<double>(frame.frame_index), 0.2 * step);
  }
}

TEST_F(TrackingTest, LocalMapStartsWithTheKeyFrameThatSharesMost) {
  scene_.FillMap({CameraAt(0.0), CameraAt(0.2), CameraAt(0.4)}, map_);
  Frame frame = scene_.MakeFrame(3, CameraAt(0.4));
  frame.map_points = map_.keyframe(KeyFrameId(2)).map_points;
  map_.RemoveObservation(frame.map_points[0], KeyFrameId(0));
  map_.RemoveObservation(frame.map_points[1], KeyFrameId(1));
  map_.RemoveObservation(frame.map_points[2], KeyFrameId(1));
  const LocalMap local = CollectLocalMap(map_, frame, 2);
  EXPECT_EQ(local.reference, KeyFrameId(2));
  EXPECT_EQ(local.keyframes, (std::vector<KeyFrameId>{KeyFrameId(2), KeyFrameId(0)}));
  EXPECT_EQ(static_cast<int>(local.points.size()), kPoints);
}

TEST_F(TrackingTest, KeyFrameIsDueWhenTheViewChangesOrTimePasses) {
  scene_.FillMap({CameraAt(0.0), CameraAt(0.2), CameraAt(0.4)}, map_);
  const KeyFrameId reference = map_.newest_keyframe();
  const KeyFrameDecisionOptions options;
  EXPECT_FALSE(ShouldBecomeKeyFrame(map_, kPoints, reference, 1, options));
  EXPECT_TRUE(ShouldBecomeKeyFrame(map_, kPoints / 2, reference, 1, options));
  EXPECT_TRUE(ShouldBecomeKeyFrame(map_, kPoints, reference, options.max_frames_between, options));
  EXPECT_FALSE(ShouldBecomeKeyFrame(map_, options.min_tracked_points - 1, reference, 100, options));
}

TEST(TrackingState, EveryRefusalHasANameAndAnExplanation) {
  for (int i = 0; i < static_cast<int>(FrameRefusal::kCount); ++i) {
    const auto refusal = static_cast<FrameRefusal>(i);
    EXPECT_FALSE(Name(refusal).empty());
    EXPECT_EQ(Explain(refusal).back(), '.') << Name(refusal);
  }
}

}  // namespace
}  // namespace lift_slam
