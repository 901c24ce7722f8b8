#include "apps/run_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

TEST(RunLog, WritesEveryLineToTheFileAndWarningsToStderr) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lift_slam_run_log_test.txt";
  WriteTextAtomically(path, "a log of another run\n");
  testing::internal::CaptureStderr();
  {
    RunLog log(path);
    log.Info("frame {} read");  // braces are text
    log.Warning("frame 7 cannot be decoded");
    EXPECT_EQ(ReadLines(path).size(), 2U) << "not on disk while the run goes on";
    EXPECT_EQ(log.WriteError(), "");
  }
  const std::string shown = testing::internal::GetCapturedStderr();
  const std::vector<std::string> lines = ReadLines(path);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], EndsWith(" info: frame {} read"));
  EXPECT_THAT(lines[1], EndsWith(" warning: frame 7 cannot be decoded"));
  EXPECT_THAT(shown, HasSubstr("lift_slam: warning: frame 7 cannot be decoded"));
  EXPECT_THAT(shown, testing::Not(HasSubstr("read")));
  std::filesystem::remove(path);
}

TEST(RunLog, FileThatCannotBeCreatedIsAnInputError) {
  EXPECT_THROW(RunLog("/proc/nonexistent/log.txt"), InputError);
}

TEST(RunLog, FullDiskIsRemembered) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  RunLog log("/dev/full");
  log.Info("first");
  EXPECT_NE(log.WriteError(), "");
}

}  // namespace
}  // namespace lift_slam
