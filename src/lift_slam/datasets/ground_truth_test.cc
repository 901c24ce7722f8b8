#include "lift_slam/datasets/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"

namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(TumPoses, AreReadWithExactTimes) {
  const TestFolder folder;
  const auto file = folder.Write("t.txt",
                                 "# t x y z qx qy qz qw\n"
                                 "1305031098.6659 1 2 3 0 0 0.70710678 0.70710678\n"
                                 "1305031098.6758 4 5 6 0 0 0 1\n");
  const Trajectory poses = ReadTumPoses(file, InvalidRows::kRefuse, nullptr);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].timestamp_ns, 1305031098665900000);
  EXPECT_EQ(poses[1].world_from_cam.translation, Eigen::Vector3d(4, 5, 6));
  const Eigen::Vector3d turned = poses[0].world_from_cam.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR((turned - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-8);
}

TEST(TumPoses, AreSortedByTime) {
  const TestFolder folder;
  const auto file = folder.Write("t.txt", "2 0 0 0 0 0 0 1\n1 9 0 0 0 0 0 1\n");
  const Trajectory poses = ReadTumPoses(file, InvalidRows::kRefuse, nullptr);
  EXPECT_EQ(poses.front().world_from_cam.translation.x(), 9.0);
}

TEST(TumPoses, NanIsRefusedWithFileAndLine) {
  const TestFolder folder;
  const auto file = folder.Write("t.txt", "1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n");
  const auto read = [&] { ReadTumPoses(file, InvalidRows::kRefuse, nullptr); };
  EXPECT_THAT(InputErrorOf(read), AllOf(HasSubstr("t.txt:2"), HasSubstr("finite number")));
  EXPECT_EQ(ReadTumPoses(file, InvalidRows::kSkip, nullptr).size(), 1u);
}

TEST(TumPoses, MalformedRowsAreRefused) {
  const TestFolder folder;
  const auto error = [&](const std::string& text) {
    const auto file = folder.Write("t.txt", text);
    return InputErrorOf([&] { ReadTumPoses(file, InvalidRows::kRefuse, nullptr); });
  };
  EXPECT_THAT(error("1 0 0 0 0 0 1\n"), HasSubstr("8 numbers"));
  EXPECT_THAT(error("1 0 0 0 0 0 0.2 1\n"), HasSubstr("unit quaternion"));
  EXPECT_THAT(error("1 0 0 0 0 0 zero 1\n"), HasSubstr("column 7"));
  EXPECT_THAT(error("# nothing\n"), HasSubstr("holds no pose"));
}

TEST(TumPoses, NanosecondTimesAreNoticed) {
  const TestFolder folder;
  const auto file = folder.Write("t.txt", "1403715276512143104 0 0 0 0 0 0 1\n");
  std::vector<std::string> warnings;
  const Trajectory poses = ReadTumPoses(file, InvalidRows::kRefuse, &warnings);
  EXPECT_EQ(poses[0].timestamp_ns, 1403715276512143104);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("nanoseconds"));
}

TEST(KittiPoses, CountRowsOrTakeTheirIndex) {
  const TestFolder folder;
  const auto twelve = folder.Write("a.txt", "1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 4 0 1 0 5 0 0 1 6\n");
  EXPECT_EQ(ReadKittiPoses(twelve)[1].frame_index, 1);
  EXPECT_EQ(ReadKittiPoses(twelve)[1].world_from_cam.translation, Eigen::Vector3d(4, 5, 6));
  const auto thirteen = folder.Write("b.txt", "7 1 0 0 1 0 1 0 2 0 0 1 3\n");
  EXPECT_EQ(ReadKittiPoses(thirteen)[0].frame_index, 7);
}

TEST(KittiPoses, NanAndScaledRotationsAreRefused) {
  const TestFolder folder;
  const auto nan = folder.Write("a.txt", "1 0 0 nan 0 1 0 2 0 0 1 3\n");
  EXPECT_THAT(InputErrorOf([&] { ReadKittiPoses(nan); }), HasSubstr("a.txt:1"));
  const auto scaled = folder.Write("b.txt", "2 0 0 1 0 2 0 2 0 0 2 3\n");
  EXPECT_THAT(InputErrorOf([&] { ReadKittiPoses(scaled); }), HasSubstr("rotation"));
}

TEST(EurocPoses, PutTheQuaternionsScalarFirst) {
  const TestFolder folder;
  const auto file = folder.Write("data.csv",
                                 "#timestamp, p_RS_R_x [m], ...\n"
                                 "1403715276512143104,1,2,3,0.0,1.0,0.0,0.0,9,9,9\n");
  const Trajectory poses = ReadEurocPoses(file);
  EXPECT_EQ(poses[0].timestamp_ns, 1403715276512143104);
  EXPECT_EQ(poses[0].world_from_cam.rotation.x(), 1.0);
}

TEST(PoseFileKind, IsFoundFromTheFirstRow) {
  const TestFolder folder;
  EXPECT_EQ(DetectPoseFile(folder.Write("a.txt", "1 0 0 0 0 0 0 1\n")), PoseFileKind::kTum);
  EXPECT_EQ(DetectPoseFile(folder.Write("b.txt", "1 0 0 1 0 1 0 2 0 0 1 3\n")),
            PoseFileKind::kKitti);
  EXPECT_EQ(DetectPoseFile(folder.Write("c.csv", "#x\n1,0,0,0,1,0,0,0\n")), PoseFileKind::kEuroc);
  const auto other = folder.Write("d.txt", "1 2 3\n");
  EXPECT_THAT(InputErrorOf([&] { DetectPoseFile(other); }), HasSubstr("8 numbers (TUM)"));
}

TEST(MissingOverlap, GivesBothRangesAndSuspectsUnits) {
  Trajectory truth(2);
  truth[0].timestamp_ns = 1'000'000'000;
  truth[1].timestamp_ns = 2'500'000'000;
  EXPECT_EQ(DescribeMissingOverlap(truth, 2'000'000'000, 9'000'000'000), std::nullopt);
  const auto apart = DescribeMissingOverlap(truth, 3'000'000'000, 4'000'000'000);
  ASSERT_TRUE(apart);
  EXPECT_THAT(*apart, AllOf(HasSubstr("1.000000000 s to 2.500000000 s"),
                            HasSubstr("3.000000000 s to 4.000000000 s")));
  EXPECT_THAT(*apart, testing::Not(HasSubstr("mixed up")));
  const auto units =
      DescribeMissingOverlap(truth, 3'000'000'000'000'000'000, 3'000'000'001'000'000'000);
  ASSERT_TRUE(units);
  EXPECT_THAT(*units, HasSubstr("seconds and nanoseconds mixed up?"));
}

}  // namespace
}  // namespace lift_slam
