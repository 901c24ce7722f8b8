#include "apps/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace lift_slam {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

Progress At(std::int64_t frames) { return {frames, 160, "tracking", 5, 812}; }

class ProgressBarTest : public testing::Test {
 protected:
  ProgressBar Bar(ProgressBar::Mode mode, int columns = 200) {
    return {out_, mode, columns, start_};
  }

  std::ostringstream out_;
  const ProgressBar::TimePoint start_{std::chrono::hours(1)};
};

TEST_F(ProgressBarTest, ShowsShareRateTimeLeftStateAndMap) {
  ProgressBar bar = Bar(ProgressBar::Mode::kTerminal);
  bar.Update(At(40), start_ + milliseconds(2000));
  EXPECT_EQ(out_.str(),
            "\r[#####---------------] 40/160 frames, 20.0/s, 0:06 left, tracking, 5 keyframes, "
            "812 points\x1b[K");
}

TEST_F(ProgressBarTest, DrawsAtMostTenTimesASecond) {
  ProgressBar bar = Bar(ProgressBar::Mode::kTerminal);
  for (int i = 0; i < 1000; ++i) bar.Update(At(i), start_ + milliseconds(i));
  const std::string text = out_.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 10);
}

TEST_F(ProgressBarTest, FitsIntoTheTerminal) {
  ProgressBar bar = Bar(ProgressBar::Mode::kTerminal, 30);
  bar.Update(At(40), start_ + milliseconds(2000));
  EXPECT_EQ(out_.str(), "\r[#####---------------] 40/160\x1b[K");
}

TEST_F(ProgressBarTest, IsQuietUntilTheEndElsewhere) {
  ProgressBar bar = Bar(ProgressBar::Mode::kQuiet);
  bar.Update(At(40), start_ + milliseconds(2000));
  EXPECT_EQ(out_.str(), "");
  bar.Finish(At(160), start_ + milliseconds(8000));
  EXPECT_EQ(out_.str(),
            "160/160 frames in 8.0 s (20.0 frames/s), tracking, 5 keyframes, 812 points\n");
}

TEST_F(ProgressBarTest, WorksWithoutKnownLengthAndBeforeTheFirstFrame) {
  ProgressBar bar = Bar(ProgressBar::Mode::kTerminal);
  bar.Update({0, std::nullopt, "initializing", 0, 0}, start_);
  EXPECT_THAT(out_.str(), HasSubstr("0 frames, 0.0/s, initializing"));
  bar.Update({0, 0, "initializing", 0, 0}, start_ + milliseconds(200));
  EXPECT_THAT(out_.str(), HasSubstr("0/0 frames, 0.0/s, ? left"));
}

TEST_F(ProgressBarTest, LongTimesShowHours) {
  ProgressBar bar = Bar(ProgressBar::Mode::kTerminal);
  bar.Update({1, 7301, "tracking", 1, 1}, start_ + milliseconds(1000));
  EXPECT_THAT(out_.str(), HasSubstr("2:01:40 left"));
}

}  // namespace
}  // namespace lift_slam
