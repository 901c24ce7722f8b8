// Runs the program itself: exit codes and what it prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "apps/program_for_test.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Program, HelpListsCommandsAndExamples) {
  const Outcome outcome = RunProgram("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"config", "info", "Examples:", "Exit codes:"}) {
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
  EXPECT_THAT(RunProgram("config --help").output, HasSubstr("--set KEY=VALUE"));
}

TEST(Program, VersionNamesTheRevision) {
  const Outcome outcome = RunProgram("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, testing::MatchesRegex("lift_slam [0-9.]+ \\([0-9a-z-]+\\)\n"));
}

TEST(Program, InfoNamesLibrariesAndMachine) {
  const Outcome outcome = RunProgram("info");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"OpenCV", "Eigen", "Ceres", "CPU features", "threads", "memory"}) {
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
}

TEST(Program, WrongCommandLineIsOneSentenceAndExitCodeOne) {
  for (const char* arguments : {"", "cofnig", "--nonsense", "config --nonsense", "info extra",
                                "config --set seed=1 extra"}) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: ")) << arguments;
    EXPECT_THAT(outcome.output, HasSubstr("--help'")) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << arguments;
  }
  EXPECT_THAT(RunProgram("cofnig").output,
              HasSubstr("unknown command 'cofnig'; the nearest known is "
                        "'config'"));
}

TEST(Program, PrintedConfigurationIsAcceptedAsAFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lift_slam_main_test.yaml";
  const Outcome defaults = RunProgram("config");
  ASSERT_EQ(defaults.exit_code, 0);
  EXPECT_THAT(defaults.output, HasSubstr("seed: "));
  WriteTextAtomically(path, defaults.output);
  EXPECT_EQ(RunProgram("config --config " + path.string()).output, defaults.output);
  EXPECT_THAT(RunProgram("config --set seed=7 --set seed=8").output, HasSubstr("seed: 8\n"));
  std::filesystem::remove(path);
}

TEST(Program, BadConfigurationNamesFileLineAndKey) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lift_slam_main_test_bad.yaml";
  WriteTextAtomically(path, "\nsede: 5\n");
  const Outcome outcome = RunProgram("config --config " + path.string());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.output, "lift_slam: " + path.string() +
                                ":2: unknown option 'sede'; the nearest known is 'seed'\n");
  std::filesystem::remove(path);
  EXPECT_EQ(RunProgram("config --config /nonexistent.yaml").output,
            "lift_slam: /nonexistent.yaml: no such file\n");
}

TEST(Program, FilesThatCannotBeReachedAreBadInput) {
  const TemporaryFolder folder;
  const std::string loop = (folder / "loop.yaml").string(), name(300, 'x');
  std::filesystem::create_symlink("loop.yaml", loop);
  for (const auto& [arguments, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"report " + loop, loop + ": Too many levels of symbolic links"},
           {"report " + name, name + ": File name too long"},
           {"config --config " + loop, loop + ": cannot be read: Too many levels of symbolic"}}) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: " + complaint));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << arguments;
  }
}

TEST(Program, FullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const Outcome outcome = RunProgram("config 2>&1 >/dev/full");
  EXPECT_EQ(outcome.exit_code, 1);
}

}  // namespace
}  // namespace lift_slam
