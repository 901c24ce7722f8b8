#include "lift_slam/loop_closing/loop_bundle.h"

#include <gtest/gtest.h>

#include "lift_slam/loop_closing/drifted_loop_for_test.h"
#include "lift_slam/map/map_consistency_for_test.h"

namespace lift_slam {
namespace {

LoopBundleOptions After(int keyframes) {
  LoopBundleOptions options;
  options.merge_after_keyframes = keyframes;
  options.bundle.max_squared_error = 1e6;
  options.bundle.function_tolerance = 1e-9;
  options.bundle.robust_iterations = 20;
  options.bundle.plain_iterations = 20;
  return options;
}

// A map after its loop has been corrected: what is left of the drift is for the adjustment.
struct CorrectedLoop : DriftedLoop {
  CorrectedLoop() {
    LoopCorrectionOptions options;
    options.min_graph_shared_points = 40;
    CorrectLoop(match, loop, tree, {}, options, map);
  }
  // The camera stands still; the new keyframe sees what the newest one sees.
  KeyFrameId AddKeyFrameAtTheEnd() {
    const KeyFrame& newest = map.keyframe(map.newest_keyframe());
    Frame frame =
        scene.MakeFrame(static_cast<int>(map.newest_keyframe().index()) + 1, true_poses.back());
    frame.cam_from_world = newest.cam_from_world;
    const std::vector<MapPointId> points = newest.map_points;
    const KeyFrameId id = map.AddKeyFrame(frame);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].valid()) map.AddObservation(points[i], id, static_cast<int>(i));
    }
    true_poses.push_back(true_poses.back());
    tree.Add(id, map);
    return id;
  }
};

TEST(LoopBundle, MergesWhenItsTimeHasComeAndNotBefore) {
  CorrectedLoop loop;
  LoopBundle bundle(After(2));
  EXPECT_FALSE(bundle.KeyFrameAdded(loop.tree, loop.map));
  bundle.Begin(loop.map);
  loop.AddKeyFrameAtTheEnd();
  EXPECT_FALSE(bundle.KeyFrameAdded(loop.tree, loop.map));
  EXPECT_TRUE(bundle.is_running());
  loop.AddKeyFrameAtTheEnd();
  EXPECT_TRUE(bundle.KeyFrameAdded(loop.tree, loop.map));
  EXPECT_FALSE(bundle.is_running());
}

TEST(LoopBundle, TakesOutWhatTheGraphLeftAndKeyFramesMadeMeanwhileFollow) {
  CorrectedLoop loop;
  const double error = loop.LargestPoseError();
  ASSERT_GT(error, 0.03);
  LoopBundle bundle(After(1));
  bundle.Begin(loop.map);
  const KeyFrameId added = loop.AddKeyFrameAtTheEnd();
  const KeyFrameId parent = *loop.tree.Parent(added);
  const auto relative = [&] {
    return loop.map.keyframe(added).cam_from_world *
           Inverse(loop.map.keyframe(parent).cam_from_world);
  };
  const Rigid3d before = relative();
  const auto report = bundle.KeyFrameAdded(loop.tree, loop.map);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->keyframes, added.value);
  EXPECT_LT(loop.LargestPoseError(), 0.3 * error);
  const double scale = report->scale_of_keyframe[parent.index()];
  EXPECT_EQ(report->scale_of_keyframe[added.index()], scale);
  EXPECT_LT((relative().translation - scale * before.translation).norm(), 1e-9);
  ExpectConsistent(loop.map);
}

TEST(LoopBundle, ScalesAreThoseOfTheDepths) {
  CorrectedLoop loop;
  const KeyFrameId middle(60);
  const MapPointId point = loop.map.PointsSeenBy({middle}).front();
  const auto depth = [&] {
    return (loop.map.keyframe(middle).cam_from_world * loop.map.point(point).position).z();
  };
  const double before = depth();
  LoopBundle bundle(After(1));
  bundle.Begin(loop.map);
  loop.AddKeyFrameAtTheEnd();
  const auto report = bundle.KeyFrameAdded(loop.tree, loop.map);
  ASSERT_TRUE(report);
  ASSERT_EQ(report->scale_of_keyframe.size(), loop.true_poses.size());
  EXPECT_NEAR(report->scale_of_keyframe[middle.index()], depth() / before, 0.01);
}

TEST(LoopBundle, ErasedKeyFramesAndPointsAreLeftOut) {
  CorrectedLoop loop;
  LoopBundle bundle(After(1));
  bundle.Begin(loop.map);
  loop.map.EraseKeyFrame(KeyFrameId(40));
  loop.map.ErasePoint(loop.map.PointIds()[7]);
  loop.tree.ForgetErased(loop.map);
  loop.AddKeyFrameAtTheEnd();
  EXPECT_TRUE(bundle.KeyFrameAdded(loop.tree, loop.map));
  ExpectConsistent(loop.map);
}

TEST(LoopBundle, GivenUpOneIsNotMerged) {
  CorrectedLoop loop;
  LoopBundle bundle(After(1));
  bundle.Begin(loop.map);
  bundle.GiveUp();
  loop.AddKeyFrameAtTheEnd();
  EXPECT_FALSE(bundle.KeyFrameAdded(loop.tree, loop.map));
}

}  // namespace
}  // namespace lift_slam
