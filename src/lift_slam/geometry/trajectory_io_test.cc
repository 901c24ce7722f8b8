#include "lift_slam/geometry/trajectory_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class TrajectoryIo : public testing::Test {
 protected:
  ~TrajectoryIo() override { std::filesystem::remove(path_); }

  const std::filesystem::path& Write(const std::string& text) {
    WriteTextAtomically(path_, text);
    return path_;
  }

  std::string ErrorOf(const std::string& text,
                      std::optional<TrajectoryFormat> format = std::nullopt) {
    try {
      ReadTrajectory(Write(text), format);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  TrajectoryFile RoundTrip(const Trajectory& trajectory, TrajectoryFormat written) {
    WriteTrajectory(trajectory, written, path_);
    return ReadTrajectory(path_);
  }

 private:
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("lift_slam_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".txt");
};

Trajectory RandomTrajectory(int size) {
  Random random(5);
  Trajectory trajectory;
  for (int i = 0; i < size; ++i) {
    const Eigen::Quaterniond rotation(random.Normal(), random.Normal(), random.Normal(),
                                      random.Normal());
    const Eigen::Vector3d position(random.Normal(), 100.0 * random.Normal(),
                                   1e-3 * random.Normal());
    trajectory.push_back({.frame_index = i,
                          .timestamp_ns = 1403715529112143517 + i * std::int64_t{49999937},
                          .world_from_cam = Rigid3d(rotation, position)});
  }
  return trajectory;
}

void ExpectSamePoses(const Trajectory& actual, const Trajectory& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const Rigid3d difference = Inverse(expected[i].world_from_cam) * actual[i].world_from_cam;
    EXPECT_LT(difference.translation.norm(), 1e-9);
    EXPECT_LT(RotationAngle(difference.rotation), 1e-9);
  }
}

void ExpectSameStamps(const Trajectory& actual, const Trajectory& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].timestamp_ns, expected[i].timestamp_ns);
  }
}

TEST_F(TrajectoryIo, TumRoundTripKeepsStampsExactlyAndPosesToNineDecimals) {
  const Trajectory trajectory = RandomTrajectory(50);
  const TrajectoryFile file = RoundTrip(trajectory, TrajectoryFormat::kTum);
  EXPECT_EQ(file.format, TrajectoryFormat::kTum);
  EXPECT_TRUE(file.warnings.empty());
  ExpectSameStamps(file.trajectory, trajectory);
  ExpectSamePoses(file.trajectory, trajectory);
}

TEST_F(TrajectoryIo, EurocFormatsKeepNineteenDigitStamps) {
  const Trajectory trajectory = RandomTrajectory(50);
  for (const auto format : {TrajectoryFormat::kEurocCsv, TrajectoryFormat::kEurocResult}) {
    const TrajectoryFile file = RoundTrip(trajectory, format);
    EXPECT_EQ(file.format, format);
    ExpectSameStamps(file.trajectory, trajectory);
    ExpectSamePoses(file.trajectory, trajectory);
  }
}

TEST_F(TrajectoryIo, KittiWithEveryFrameHasTwelveColumns) {
  const Trajectory trajectory = RandomTrajectory(20);
  const TrajectoryFile file = RoundTrip(trajectory, TrajectoryFormat::kKitti);
  EXPECT_EQ(file.format, TrajectoryFormat::kKitti);
  EXPECT_TRUE(file.nominal_timestamps);
  ExpectSamePoses(file.trajectory, trajectory);
  EXPECT_EQ(file.trajectory[7].frame_index, 7);
  EXPECT_EQ(file.trajectory[7].timestamp_ns, 700000000);
}

TEST_F(TrajectoryIo, KittiWithLostFramesKeepsTheirIndex) {
  Trajectory trajectory = RandomTrajectory(20);
  trajectory[0].state = PoseState::kNotInitialized;
  trajectory[5].state = PoseState::kLost;
  const TrajectoryFile file = RoundTrip(trajectory, TrajectoryFormat::kKitti);
  EXPECT_EQ(file.format, TrajectoryFormat::kKittiIndexed);
  ASSERT_EQ(file.trajectory.size(), 18U);
  EXPECT_EQ(file.trajectory[0].frame_index, 1);
  EXPECT_EQ(file.trajectory[4].frame_index, 6);
}

TEST_F(TrajectoryIo, KittiWithoutFrameIndexCannotBeWritten) {
  std::ostringstream stream;
  EXPECT_THROW(WriteTrajectory({TrajectoryPose{}}, TrajectoryFormat::kKitti, stream), InputError);
}

TEST_F(TrajectoryIo, TumQuaternionIsXyzwAndEurocCsvWxyz) {
  const Rigid3d tum = ReadTrajectory(Write("1.5 1 2 3 1 0 0 0\n")).trajectory.at(0).world_from_cam;
  EXPECT_NEAR(tum.rotation.x(), 1.0, 1e-12);
  const Rigid3d euroc =
      ReadTrajectory(Write("#timestamp, p\r\n1403715524907143168,1,2,3,1,0,0,0,9,\r\n"))
          .trajectory.at(0)
          .world_from_cam;
  EXPECT_NEAR(euroc.rotation.w(), 1.0, 1e-12);
  EXPECT_EQ(euroc.translation, Eigen::Vector3d(1, 2, 3));
}

TEST_F(TrajectoryIo, EurocResultUnitIsDetectedWithAWarning) {
  const std::string pose = " 0 0 0 0 0 0 1\n";
  const TrajectoryFile ns = ReadTrajectory(Write("1403715529112143517.0" + pose));
  EXPECT_EQ(ns.format, TrajectoryFormat::kEurocResult);
  EXPECT_EQ(ns.trajectory.at(0).timestamp_ns, 1403715529112143517);
  ASSERT_EQ(ns.warnings.size(), 1U);
  EXPECT_THAT(ns.warnings[0], HasSubstr("nanoseconds"));
  const TrajectoryFile s =
      ReadTrajectory(Write("1403715529.112143517" + pose), TrajectoryFormat::kEurocResult);
  EXPECT_EQ(s.trajectory.at(0).timestamp_ns, 1403715529112143517);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_THAT(s.warnings[0], HasSubstr(" seconds"));
}

TEST_F(TrajectoryIo, MixedUnitsAreRefused) {
  EXPECT_THAT(ErrorOf("1403715529112143517 0 0 0 0 0 0 1\n1403715529.2 0 0 0 0 0 0 1\n"),
              HasSubstr(":2: timestamp 1403715529.2 looks like seconds"));
  EXPECT_THAT(ErrorOf("1403715529112143517 0 0 0 0 0 0 1\n", TrajectoryFormat::kTum),
              HasSubstr("looks like nanoseconds"));
  EXPECT_THAT(ErrorOf("1403715529.1,0,0,0,1,0,0,0\n"), HasSubstr("looks like seconds"));
}

TEST_F(TrajectoryIo, MalformedLinesAreNamedByFileAndLine) {
  const std::string good = "1.0 0 0 0 0 0 0 1\n";
  EXPECT_THAT(ErrorOf(good + "2.0 0 nan 0 0 0 0 1\n"),
              AllOf(HasSubstr("MalformedLines"), HasSubstr(".txt:2: column 3 is nan")));
  EXPECT_THAT(ErrorOf(good + "2.0 0 x 0 0 0 0 1\n"), HasSubstr(":2: column 3 is 'x'"));
  EXPECT_THAT(ErrorOf(good + "2.0 0 0 0 0 0 1\n"), HasSubstr(":2: 7 columns, expected 8"));
  EXPECT_THAT(ErrorOf(good + "2.0 0 0 0 0 0 0 1.002\n"), HasSubstr("norm 1.002"));
  EXPECT_THAT(ErrorOf(good + "2.0 0 0 0 0 0 0 0\n"), HasSubstr("norm 0.000"));
  EXPECT_THAT(ErrorOf("1 2 3\n"), HasSubstr(":1: 3 columns"));
  EXPECT_THAT(ErrorOf(good + "2.0 0 1e300 0 0 0 0 1\n"), HasSubstr(":2: the position (0, 1e+300"));
  EXPECT_EQ(ErrorOf(good + "2.0 0 0 0 0 0 0 1.0009\n"), "no error");
}

TEST_F(TrajectoryIo, MalformedKittiFilesAreRefused) {
  const std::string good = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_THAT(ErrorOf(good + "-1 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr(":2: the 3x3 block"));
  EXPECT_THAT(ErrorOf(good + "1 0 0 -1e13 0 1 0 0 0 0 1 0\n"), HasSubstr(":2: the position"));
  EXPECT_THAT(ErrorOf(good + "1 0 0 0 0 1 0.01 0 0 0 1 0\n"), HasSubstr(":2: the 3x3 block"));
  EXPECT_THAT(ErrorOf(good + "\n" + good), HasSubstr(":2: empty line"));
  EXPECT_EQ(ErrorOf(good + good + "\n\n"), "no error");
  EXPECT_THAT(ErrorOf("3 " + good + "3 " + good), HasSubstr(":2: frame index '3'"));
  EXPECT_THAT(ErrorOf("0.5 " + good), HasSubstr(":1: frame index '0.5'"));
}

TEST_F(TrajectoryIo, RepeatedAndUnorderedStampsAreRepairedWithAWarning) {
  const TrajectoryFile file =
      ReadTrajectory(Write("2.0 5 0 0 0 0 0 1\n1.0 6 0 0 0 0 0 1\n2.0 7 0 0 0 0 0 1\n"));
  ASSERT_EQ(file.trajectory.size(), 2U);
  EXPECT_EQ(file.trajectory[0].world_from_cam.translation.x(), 6.0);
  EXPECT_EQ(file.trajectory[1].world_from_cam.translation.x(), 5.0);
  EXPECT_EQ(file.warnings.size(), 2U);
}

TEST_F(TrajectoryIo, RowsWithNanAreSkippedOnDemand) {
  const auto& path = Write("1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\nNaN 0 0 0 0 0 0 1\n");
  const TrajectoryFile file = ReadTrajectory(path, TrajectoryFormat::kTum, NanRows::kSkip);
  EXPECT_EQ(file.trajectory.size(), 1U);
  EXPECT_THROW(ReadTrajectory(path, TrajectoryFormat::kTum), InputError);
}

TEST_F(TrajectoryIo, WholeStampsOfCommaSeparatedFilesAreNanosecondsFromTheFirst) {
  const TrajectoryFile file =
      ReadTrajectory(Write("#timestamp, p\n0,1,2,3,1,0,0,0\n50000000,1,2,4,1,0,0,0\n"));
  EXPECT_EQ(file.format, TrajectoryFormat::kEurocCsv);
  EXPECT_EQ(file.trajectory.at(1).timestamp_ns, 50'000'000);
}

TEST_F(TrajectoryIo, KittiFramesCountRowsOrTakeTheirIndex) {
  const std::string pose = "1 0 0 4 0 1 0 5 0 0 1 6\n";
  const TrajectoryFile counted = ReadTrajectory(Write(pose + pose));
  EXPECT_EQ(counted.trajectory.at(1).frame_index, 1);
  EXPECT_EQ(counted.trajectory.at(1).world_from_cam.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(ReadTrajectory(Write("7 " + pose)).trajectory.at(0).frame_index, 7);
  EXPECT_THAT(ErrorOf("1 0 0 nan 0 1 0 2 0 0 1 3\n"), HasSubstr(":1: column 4 is nan"));
}

TEST_F(TrajectoryIo, ByteOrderMarkIsNoColumn) {
  EXPECT_EQ(ReadTrajectory(Write("\xEF\xBB\xBF"
                                 "1 0 0 0 0 0 0 1\n"))
                .trajectory.size(),
            1U);
}

TEST_F(TrajectoryIo, EmptyFileGivesAnEmptyTrajectoryAndAWarning) {
  const TrajectoryFile file = ReadTrajectory(Write("# nothing\n"));
  EXPECT_TRUE(file.trajectory.empty());
  EXPECT_EQ(file.warnings.size(), 1U);
  EXPECT_EQ(DetectTrajectoryFormat(Write("")), std::nullopt);
}

TEST_F(TrajectoryIo, TimestampsFileMustIncrease) {
  EXPECT_EQ(ReadTimestamps(Write("0.000000e+00\n1.037359e-01\n")),
            (std::vector<std::int64_t>{0, 103735900}));
  EXPECT_THROW(ReadTimestamps(Write("1.0\n1.0\n")), InputError);
  EXPECT_THROW(ReadTimestamps(Write("1.0 2.0\n")), InputError);
  EXPECT_THROW(ReadTimestamps(Write("1.0\n\n2.0\n")), InputError);
  EXPECT_EQ(ReadTimestamps(Write("1.0\n2.0\n\n")).size(), 2U);
}

}  // namespace
}  // namespace lift_slam
