#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/prefetching_sequence.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"

// The real sequences, where they are at hand.
namespace lift_slam {
namespace {

struct Expected {
  const char* path;
  SequenceFormat format;
  std::int64_t num_frames;
  PinholeIntrinsics pinhole;
  std::int64_t first_ns, last_ns;
  std::size_t num_truth;  // 0: none
};

const Expected kExpected[] = {
    {"kitti/sequences/00",
     SequenceFormat::kKittiOdometry,
     160,
     {718.856, 718.856, 607.1928, 185.2157, 1241, 376},
     0,
     16485710000,
     160},
    {"kitti/sequences/06",
     SequenceFormat::kKittiOdometry,
     51,
     {707.0912, 707.0912, 601.8873, 183.1104, 1226, 370},
     0,
     5185000000,
     51},
    {"kitti_raw/2011_09_26/2011_09_26_drive_0005_sync",
     SequenceFormat::kKittiRaw,
     154,
     {721.5377, 721.5377, 609.5593, 172.854, 1242, 375},
     0,
     15300000000,
     0},
    {"7scenes_redkitchen",
     SequenceFormat::kTumRgbd,
     1000,
     {540, 540, 320, 240, 640, 480},
     0,
     33300000000,
     1000},
    {"euroc/V1_01_easy_static30",
     SequenceFormat::kEuroc,
     30,
     {458.654, 457.296, 367.215, 248.375, 752, 480},
     1403715276512143104,
     1403715277962142976,
     30},
};

class RealSequence : public testing::TestWithParam<Expected> {};

TEST_P(RealSequence, OpensWithTheRightFigures) {
  const auto data = RealData();
  if (!data) GTEST_SKIP() << "no real data (LIFT_SLAM_DATA)";
  const Expected& expected = GetParam();
  PrefetchingSequence sequence(OpenSequence((*data / expected.path).string()));
  const SequenceInfo& info = sequence.info();
  for (const std::string& warning : info.warnings) std::cout << "warning: " << warning << "\n";
  EXPECT_EQ(info.format, expected.format);
  EXPECT_EQ(info.num_frames, expected.num_frames);
  const PinholeIntrinsics& pinhole = info.camera->pinhole;
  EXPECT_DOUBLE_EQ(pinhole.fx, expected.pinhole.fx);
  EXPECT_DOUBLE_EQ(pinhole.fy, expected.pinhole.fy);
  EXPECT_DOUBLE_EQ(pinhole.cx, expected.pinhole.cx);
  EXPECT_DOUBLE_EQ(pinhole.cy, expected.pinhole.cy);
  EXPECT_EQ(pinhole.width, expected.pinhole.width);
  EXPECT_EQ(pinhole.height, expected.pinhole.height);
  EXPECT_EQ(info.ground_truth ? info.ground_truth->poses.size() : 0, expected.num_truth);

  const std::vector<SequenceFrame> frames = ReadAll(sequence);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(expected.num_frames));
  EXPECT_EQ(frames.front().timestamp_ns, expected.first_ns);
  EXPECT_EQ(frames.back().timestamp_ns, expected.last_ns);
  for (const SequenceFrame& frame : frames) {
    ASSERT_TRUE(frame.image) << frame.problem_text;
    EXPECT_EQ(frame.image->width(), expected.pinhole.width);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RealSequence, testing::ValuesIn(kExpected));

TEST(RealEuroc, CameraTruthIsThatOfTheConvertedFile) {
  const auto data = RealData();
  if (!data) GTEST_SKIP() << "no real data (LIFT_SLAM_DATA)";
  const auto sequence = OpenSequence((*data / "euroc/V1_01_easy_static30").string());
  const GroundTruth& truth = *sequence->info().ground_truth;
  // Camera 0 poses of the whole recording from another source.
  const Trajectory reference =
      ReadTrajectory(*data / "euroc/groundtruth_cam0_tum/V1_01_easy.txt").trajectory;
  int num_compared = 0;
  for (const TrajectoryPose& pose : truth.poses) {
    for (const TrajectoryPose& other : reference) {
      if (std::abs(other.timestamp_ns - pose.timestamp_ns) > 1'000'000) continue;
      ++num_compared;
      EXPECT_LT((other.world_from_cam.translation - pose.world_from_cam.translation).norm(), 1e-4);
      EXPECT_LT(
          RotationAngle(other.world_from_cam.rotation.conjugate() * pose.world_from_cam.rotation),
          1e-4);
    }
  }
  EXPECT_GE(num_compared, 25);
  EXPECT_GT((truth.body_poses->front().world_from_cam.translation -
             truth.poses.front().world_from_cam.translation)
                .norm(),
            0.05);
}

TEST(RealKitti, TruthGivenByOptionIsPairedByIndex) {
  const auto data = RealData();
  if (!data) GTEST_SKIP() << "no real data (LIFT_SLAM_DATA)";
  SequenceOptions options;
  options.ground_truth_file = *data / "kitti/poses_cut/00.txt";
  const auto sequence = OpenSequence((*data / "kitti/sequences/00").string(), options);
  const GroundTruth& truth = *sequence->info().ground_truth;
  EXPECT_TRUE(truth.by_index);
  ASSERT_EQ(truth.poses.size(), 160u);
  EXPECT_TRUE(sequence->info().warnings.empty());
  EXPECT_EQ(truth.poses[1].timestamp_ns, 103735900);
}

}  // namespace
}  // namespace lift_slam
