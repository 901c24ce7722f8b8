#include "lift_slam/simulation/frame_workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace lift_slam {
namespace {

TEST(RunFrameWorkers, DoesEveryFrameOnce) {
  std::vector<std::atomic<int>> times(100);
  std::vector<int> told;
  const int done =
      RunFrameWorkers({100,
                       4,
                       [&] { return [&](int frame) { ++times[static_cast<std::size_t>(frame)]; }; },
                       [&](int frames_done) { told.push_back(frames_done); },
                       {}});
  EXPECT_EQ(done, 100);
  for (const auto& count : times) EXPECT_EQ(count, 1);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(RunFrameWorkers, MakesATaskInEachThread) {
  std::atomic<int> made = 0;
  RunFrameWorkers({50,
                   3,
                   [&] {
                     ++made;
                     return [](int) {};
                   },
                   {},
                   {}});
  EXPECT_EQ(made, 3);
}

TEST(RunFrameWorkers, StopsWhenTold) {
  std::atomic<int> asked = 0;
  const int done =
      RunFrameWorkers({1000, 2, [] { return [](int) {}; }, {}, [&] { return ++asked > 10; }});
  EXPECT_EQ(done, 10);
}

TEST(RunFrameWorkers, ThrowsWhatATaskThrewAfterAllEnded) {
  std::atomic<int> running = 0;
  const auto fail = [&](int frame) {
    ++running;
    if (frame == 5) throw std::runtime_error("frame 5");
    --running;
  };
  try {
    RunFrameWorkers({100, 2, [&] { return fail; }, {}, {}});
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "frame 5");
  }
  EXPECT_EQ(running, 1);
}

TEST(RunFrameWorkers, ThrowsWhatMakingATaskThrew) {
  const auto make = []() -> FrameTask { throw std::runtime_error("no OpenGL"); };
  EXPECT_THROW(RunFrameWorkers({10, 2, make, {}, {}}), std::runtime_error);
}

}  // namespace
}  // namespace lift_slam
