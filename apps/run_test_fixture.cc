#include "apps/run_test_fixture.h"

#include <unistd.h>

#include <algorithm>

#include "lift_slam/util/file.h"

namespace lift_slam {

namespace fs = std::filesystem;
using testing::HasSubstr;

RunCommand::RunCommand()
    : folder_(fs::path(testing::TempDir()) / ("lift_slam_run_" + std::to_string(getpid()))) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

RunCommand::~RunCommand() { fs::remove_all(folder_); }

fs::path RunCommand::Render(SequenceLayout layout, int num_frames, SyntheticPath path) const {
  SyntheticSequenceOptions options;
  options.path = path;
  options.num_frames = num_frames;
  options.frame_rate_hz = 15.0;
  options.camera.pinhole = {375.0, 375.0, 239.5, 179.5, 480, 360};
  return WriteSyntheticSequence(folder_ / "data", layout, options).folder;
}

std::vector<fs::path> RunCommand::FilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

Outcome RunCommand::Run(const fs::path& sequence, const std::string& arguments) const {
  return RunProgram("run " + sequence.string() + " --output " + output_.string() + " " + arguments);
}

nlohmann::json RunCommand::ExpectAllOutputs(const Outcome& outcome, int exit_code) const {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
  for (const char* name : {"trajectory.tum", "trajectory_online.tum", "keyframes.tum", "map.ply",
                           "config.yaml", "report.html", "log.txt", "result.json"}) {
    EXPECT_TRUE(fs::is_regular_file(output_ / name)) << name << "\n" << outcome.output;
  }
  if (!fs::is_regular_file(output_ / "result.json")) return nlohmann::json::object();
  return nlohmann::json::parse(ReadText(output_ / "result.json"));
}

void RunCommand::ExpectOneSentence(const Outcome& outcome, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, testing::StartsWith("lift_slam: "));
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  for (const std::string& part : parts) EXPECT_THAT(outcome.output, HasSubstr(part));
}

}  // namespace lift_slam
