#include "apps/sequence_truth.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

Trajectory OnePose(std::int64_t timestamp_ns) {
  Trajectory trajectory(1);
  trajectory.front().timestamp_ns = timestamp_ns;
  return trajectory;
}

SequenceInfo InfoWithTruth(SequenceFormat format) {
  SequenceInfo info;
  info.format = format;
  info.ground_truth.emplace();
  info.ground_truth->poses = OnePose(1);
  return info;
}

TEST(SequenceTruth, PosesOfTheBodyAreTakenWhereTheyAreAskedForAndKnown) {
  SequenceInfo info = InfoWithTruth(SequenceFormat::kEuroc);
  EvaluationOptions options;
  options.gt_frame = GroundTruthFrame::kBody;
  const SequenceTruth of_camera = TruthOf(info, options);
  EXPECT_EQ(of_camera.poses.front().timestamp_ns, 1);
  EXPECT_EQ(of_camera.options.gt_frame, GroundTruthFrame::kCamera) << "as it was done";
  info.ground_truth->body_poses = OnePose(2);
  const SequenceTruth of_body = TruthOf(info, options);
  EXPECT_EQ(of_body.poses.front().timestamp_ns, 2);
  EXPECT_EQ(of_body.options.gt_frame, GroundTruthFrame::kBody);
  EXPECT_EQ(TruthOf(info, {}).poses.front().timestamp_ns, 1);
}

TEST(SequenceTruth, PairingFitsTheSequence) {
  SequenceInfo info = InfoWithTruth(SequenceFormat::kEuroc);
  const AssociationOptions of_euroc = TruthOf(info, {}).options.association;
  EXPECT_EQ(of_euroc.method, AssociationMethod::kTime);
  EXPECT_EQ(of_euroc.max_time_difference_ms, kEurocMaxTimeDifferenceMs);
  info = InfoWithTruth(SequenceFormat::kKittiOdometry);
  info.ground_truth->by_index = true;
  EXPECT_EQ(TruthOf(info, {}).options.association.method, AssociationMethod::kIndex);
  info.ground_truth.reset();
  EXPECT_TRUE(TruthOf(info, {}).poses.empty());
}

}  // namespace
}  // namespace lift_slam
