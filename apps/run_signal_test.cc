// Signals to `lift_slam run`: what is there when a run is ended from outside.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "apps/run_test_fixture.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunSignal : public RunCommand {
 protected:
  // Few images, shown forwards and backwards over and over: far longer than a test waits.
  fs::path EndlessSequence() const {
    const fs::path sequence = Render(SequenceLayout::kTumRgbd, 40);
    const std::vector<fs::path> files = FilesIn(sequence / "rgb");
    std::string list;
    for (int i = 0; i < 20000; ++i) {
      const int place = i % 78;
      const auto& file = files[static_cast<std::size_t>(place < 40 ? place : 78 - place)];
      list += fmt::format("{:.6f} rgb/{}\n", i / 15.0, file.filename().string());
    }
    WriteTextAtomically(sequence / "rgb.txt", list);
    return sequence;
  }
  std::string Arguments(const std::string& mode) const {
    return fmt::format("run {} --output {} --mode {}", EndlessSequence().string(), output_.string(),
                       mode);
  }
  // Waits until some poses are written.
  bool WaitForPoses(BackgroundProgram& program) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    std::error_code error;
    while (!program.Ended() && std::chrono::steady_clock::now() < end) {
      if (fs::file_size(output_ / "trajectory_online.tum", error) > 3000 && !error) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }
};

class EndingSignal : public RunSignal, public testing::WithParamInterface<int> {};

TEST_P(EndingSignal, LeavesAllOutputs) {
  for (const char* mode : {"sequential", "threaded"}) {
    fs::remove_all(folder_ / "data");
    fs::remove_all(output_);
    BackgroundProgram program(Arguments(mode), folder_ / "printed.txt");
    ASSERT_TRUE(WaitForPoses(program)) << ReadText(folder_ / "printed.txt");
    program.Send(GetParam());
    const int exit_code = program.Wait();
    const Outcome outcome{exit_code, ReadText(folder_ / "printed.txt")};
    const auto json = ExpectAllOutputs(outcome, 0);
    EXPECT_EQ(json["interrupted"], true);
    EXPECT_LT(json["coverage"]["frames_total"], 20000);
    EXPECT_GT(json["coverage"]["coverage"], 0.9);
    EXPECT_THAT(outcome.output, HasSubstr(GetParam() == SIGINT ? "ended early by SIGINT"
                                                               : "ended early by SIGTERM"));
  }
}

INSTANTIATE_TEST_SUITE_P(All, EndingSignal, testing::Values(SIGINT, SIGTERM),
                         [](const auto& tested) {
                           return tested.param == SIGINT ? "Interrupt" : "Terminate";
                         });

TEST_F(RunSignal, KillLeavesTheOnlineTrajectorySoFar) {
  // Of an earlier run: must not be taken for this one's.
  fs::create_directories(output_);
  WriteTextAtomically(output_ / "result.json", "{}");
  BackgroundProgram program(Arguments("threaded"), folder_ / "printed.txt");
  ASSERT_TRUE(WaitForPoses(program)) << ReadText(folder_ / "printed.txt");
  program.Send(SIGKILL);
  EXPECT_EQ(program.Wait(), -SIGKILL);
  const auto poses = ReadTrajectory(output_ / "trajectory_online.tum").trajectory;
  EXPECT_GE(poses.size(), 15U);  // WaitForPoses asks for 3000 bytes
  EXPECT_FALSE(fs::exists(output_ / "result.json"));
  EXPECT_THAT(ReadText(output_ / "log.txt"), HasSubstr("tracking"));
}

}  // namespace
}  // namespace lift_slam
