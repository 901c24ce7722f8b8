// Trajectories of other systems are judged on the frames that are run, as ours are.
#include "apps/benchmark_test_fixture.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BenchmarkExternal : public BenchmarkCommand {
 protected:
  // The truth of a rendered sequence as a system's trajectory, `copies` poses for each frame.
  static Trajectory Truth(const fs::path& sequence, int num_frames, int copies) {
    Trajectory trajectory;
    const Trajectory truth = OpenSequence(sequence.string())->info().ground_truth->poses;
    for (std::size_t i = 0; i < static_cast<std::size_t>(num_frames); ++i) {
      for (int copy = 0; copy < copies; ++copy) {
        trajectory.push_back(truth[i]);
        trajectory.back().timestamp_ns += copy * std::int64_t{15'000'000};
      }
    }
    return trajectory;
  }

  void WriteOther(const Trajectory& trajectory) const {
    fs::create_directories(folder_ / "other");
    WriteTrajectory(trajectory, TrajectoryFormat::kTum, folder_ / "other/data.tum");
  }

  // Tables of a plan without runs of ours.
  std::string Merge(const std::string& options = "") const {
    const Outcome planned =
        RunProgram(Arguments("plan shared", "default_orb") + " --runs 1 " + options);
    EXPECT_EQ(planned.exit_code, 0) << planned.output;
    const Outcome outcome =
        RunProgram(fmt::format("benchmark merge --output {} --external Other={}", output_.string(),
                               (folder_ / "other").string()));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output;
  }
};

TEST_F(BenchmarkExternal, PosesBetweenTheFramesDoNotMakeUpForMissingOnes) {
  const fs::path sequence = Render(SequenceLayout::kEuroc, 20);
  WriteOther(Truth(sequence, 6, /*copies=*/4));
  EXPECT_THAT(Merge(), HasSubstr("| data, Other | 0/1 | 30.0 |"));
}

TEST_F(BenchmarkExternal, FramesThatAreNotRunTakeNoPart) {
  const fs::path sequence = Render(SequenceLayout::kEuroc, 20);
  Trajectory trajectory = Truth(sequence, 20, /*copies=*/1);
  for (std::size_t i = 12; i < 20; ++i) trajectory[i].world_from_cam.translation.x() += 5.0;
  WriteOther(trajectory);
  EXPECT_THAT(Merge("--frames 0:11:1"), HasSubstr("| data, Other | 1/1 | 100.0 | 0.0000 |"));
}

TEST_F(BenchmarkExternal, SettingsOfTheEvaluationHold) {
  const fs::path sequence = Render(SequenceLayout::kEuroc, 20);  // 15 a second
  WriteOther(Truth(sequence, 12, /*copies=*/1));
  EXPECT_THAT(Merge(), HasSubstr("| data, Other | 1/1 | 60.0 |"));
  EXPECT_THAT(Merge("--set evaluation.status.max_lost_at_end_s=0.4"),
              HasSubstr("| data, Other | 0/1 | 60.0 |"));
}

TEST_F(BenchmarkExternal, TimesThatStandStillEndNoBenchmark) {
  const fs::path sequence = Render(SequenceLayout::kKittiOdometry, 12);
  const Trajectory truth = Truth(sequence, 12, /*copies=*/1);
  std::vector<std::string> times = ReadLines(sequence / "times.txt");
  times[5] = times[4];
  std::string text;
  for (const std::string& time : times) text += time + "\n";
  WriteTextAtomically(sequence / "times.txt", text);
  fs::create_directories(folder_ / "other");
  WriteTrajectory(truth, TrajectoryFormat::kTum, folder_ / "other/00.tum");
  EXPECT_THAT(Merge(), HasSubstr("| 00, Other | 1/1 | 91.7 | 0.0000 |")) << "all but frame 5";
}

}  // namespace
}  // namespace lift_slam
