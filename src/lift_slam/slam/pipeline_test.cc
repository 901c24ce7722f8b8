// Both modes of the pipeline: same bits, exceptions passed on, ended early.
#include "lift_slam/slam/pipeline.h"

#include <gtest/gtest.h>

#include "lift_slam/slam/run_for_test.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

SyntheticSequenceOptions Drive(int num_frames) {
  return SmallSequence(SyntheticPath::kStreetDrive, num_frames, 10.0);
}

class Pipeline : public testing::TestWithParam<RunMode> {};

TEST(PipelineModes, GiveTheSameBitsAgainAndAgain) {
  TestRunOptions options;
  const RunRecord first = RunSynthetic(Drive(40), options);
  ASSERT_GE(CountOf(first, FrameRefusal::kNone), 30);
  const RunRecord second = RunSynthetic(Drive(40), options);
  options.mode = RunMode::kThreaded;
  const RunRecord threaded = RunSynthetic(Drive(40), options);
  for (const RunRecord* other : {&second, &threaded}) {
    EXPECT_TRUE(SamePoses(first.final_trajectory, other->final_trajectory));
    EXPECT_TRUE(SamePoses(first.online_trajectory, other->online_trajectory));
    EXPECT_EQ(first.points.size(), other->points.size());
    EXPECT_EQ(first.counters, other->counters);
  }
}

TEST(PipelineModes, SamePosesTellsTrajectoriesApart) {
  Trajectory a = TrueTrajectory(Drive(5)), b = a;
  EXPECT_TRUE(SamePoses(a, b));
  b[3].world_from_cam.translation.x() += 1e-12;
  EXPECT_FALSE(SamePoses(a, b));
}

TEST_P(Pipeline, HearsOfEveryFrameInOrder) {
  TestRunOptions options;
  options.mode = GetParam();
  std::vector<std::int64_t> heard;
  options.frame_done = [&](const FrameRecord& frame) {
    heard.push_back(frame.frame_index);
    return true;
  };
  RunSynthetic(Drive(12), options);
  ASSERT_EQ(heard.size(), 12U);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i], static_cast<std::int64_t>(i));
  }
}

TEST_P(Pipeline, PassesOnAnExceptionOfTheReader) {
  TestRunOptions options;
  options.mode = GetParam();
  int done = 0;
  options.frame_done = [&](const FrameRecord&) { return ++done > 0; };
  options.change_frame = [](InputFrame& frame) {
    if (frame.frame_index == 6) throw InputError("camera unplugged");
  };
  try {
    RunSynthetic(Drive(12), options);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "camera unplugged");
  }
  EXPECT_EQ(done, 6);  // the frames before have been worked on
}

TEST_P(Pipeline, PassesOnAnExceptionOfTheListener) {
  TestRunOptions options;
  options.mode = GetParam();
  options.frame_done = [](const FrameRecord& frame) -> bool {
    if (frame.frame_index == 3) throw InputError("disk full");
    return true;
  };
  EXPECT_THROW(RunSynthetic(Drive(20), options), InputError);
}

TEST_P(Pipeline, EndsEarlyWhenAskedTo) {
  TestRunOptions options;
  options.mode = GetParam();
  options.frame_done = [](const FrameRecord& frame) { return frame.frame_index < 7; };
  const RunRecord run = RunSynthetic(Drive(40), options);
  EXPECT_EQ(run.frames.size(), 8U);
  EXPECT_EQ(run.final_trajectory.size(), 8U);
}

INSTANTIATE_TEST_SUITE_P(All, Pipeline, testing::Values(RunMode::kSequential, RunMode::kThreaded),
                         [](const auto& tested) {
                           return tested.param == RunMode::kThreaded ? "Threaded" : "Sequential";
                         });

}  // namespace
}  // namespace lift_slam
