#include "lift_slam/loop_closing/loop_corrector.h"

#include <gtest/gtest.h>

#include "lift_slam/loop_closing/drifted_loop_for_test.h"
#include "lift_slam/map/map_consistency_for_test.h"

namespace lift_slam {
namespace {

LoopCorrectionOptions TestOptions() {
  LoopCorrectionOptions options;
  options.min_graph_shared_points = 40;
  return options;
}

LoopCorrection Correct(DriftedLoop& loop) {
  return CorrectLoop(loop.match, loop.loop, loop.tree, {}, TestOptions(), loop.map);
}

TEST(LoopCorrector, DriftIsTakenOutOfPosesAndPoints) {
  DriftedLoop loop;
  const double pose_error = loop.LargestPoseError(), point_error = loop.LargestPointError();
  ASSERT_GT(pose_error, 0.4);
  ASSERT_GT(point_error, 2.0);
  const LoopCorrection correction = Correct(loop);
  ASSERT_TRUE(correction.graph.usable) << correction.graph.message;
  EXPECT_LT(loop.LargestPoseError(), 0.2 * pose_error);
  EXPECT_LT(loop.LargestPointError(), 0.2 * point_error);
}

TEST(LoopCorrector, PointsOfBothSidesBecomeOneAndTheMapStaysConsistent) {
  DriftedLoop loop;
  const int points = loop.map.num_points();
  const LoopCorrection correction = Correct(loop);
  // The copies of all groups that both sides see.
  EXPECT_EQ(correction.fused.points_merged, points - loop.map.num_points());
  EXPECT_GE(correction.fused.points_merged, DriftedLoop::kGroup * (DriftedLoop::kWindow + 2));
  EXPECT_GE(loop.map.covisibility().SharedPoints(loop.loop.query, loop.loop.candidate),
            9 * DriftedLoop::kGroup * DriftedLoop::kWindow / 10);
  ExpectConsistent(loop.map);
}

TEST(LoopCorrector, TellsByHowMuchLengthsChangedAtEachKeyFrame) {
  DriftedLoop loop;
  const LoopCorrection correction = Correct(loop);
  ASSERT_EQ(correction.scale_of_keyframe.size(), loop.true_poses.size());
  for (std::size_t i = 0; i < loop.true_poses.size(); ++i) {
    const double expected = 1.0 / loop.Drift(static_cast<int>(i)).scale;
    EXPECT_NEAR(correction.scale_of_keyframe[i], expected, 0.06 * expected) << i;
  }
}

TEST(LoopCorrector, FramesKeptRelativeToAnErasedKeyFrameFollow) {
  DriftedLoop loop;
  const KeyFrameId erased(60);
  loop.map.EraseKeyFrame(erased);
  loop.tree.ForgetErased(loop.map);
  const LoopCorrection correction = Correct(loop);
  const auto reference = loop.map.ResolveReference(erased);
  ASSERT_TRUE(reference.has_value());
  const Rigid3d pose =
      reference->cam_from_keyframe * loop.map.keyframe(reference->keyframe).cam_from_world;
  const Eigen::Vector3d truth = loop.true_poses[erased.index()].TargetOriginInSource();
  EXPECT_LT((pose.TargetOriginInSource() - truth).norm(), 0.1);
  EXPECT_EQ(correction.scale_of_keyframe[erased.index()],
            correction.scale_of_keyframe[reference->keyframe.index()]);
  ExpectConsistent(loop.map);
}

TEST(LoopCorrector, SameInputGivesTheSameBits) {
  DriftedLoop a, b;
  Correct(a);
  Correct(b);
  for (const KeyFrameId id : a.map.KeyFrameIds()) {
    EXPECT_EQ(a.map.keyframe(id).cam_from_world.translation,
              b.map.keyframe(id).cam_from_world.translation);
  }
  ASSERT_EQ(a.map.PointIds(), b.map.PointIds());
  for (const MapPointId id : a.map.PointIds()) {
    EXPECT_EQ(a.map.point(id).position, b.map.point(id).position);
  }
}

TEST(EssentialGraph, CorrectionIsSpreadFromNoneToAll) {
  DriftedLoop loop;
  EssentialGraph graph = BuildEssentialGraph(loop.map, loop.tree, {}, 40, 10);
  const std::vector<Sim3d> before = graph.graph.cams_from_world;
  const Sim3d whole(1.5, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX())),
                    {1.0, -2.0, 0.5});
  SpreadCorrection(whole, KeyFrameId(5), KeyFrameId(25), graph);
  EXPECT_EQ(graph.graph.cams_from_world[3].translation, before[3].translation);
  EXPECT_NEAR(graph.graph.cams_from_world[15].scale, 1.0 / std::sqrt(1.5), 1e-12);
  const Sim3d expected = before[30] * Inverse(whole);
  EXPECT_NEAR(graph.graph.cams_from_world[30].scale, expected.scale, 1e-12);
  EXPECT_LT((graph.graph.cams_from_world[30].translation - expected.translation).norm(), 1e-9);
}

}  // namespace
}  // namespace lift_slam
