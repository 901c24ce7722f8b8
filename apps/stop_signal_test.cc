#include "apps/stop_signal.h"

#include <gtest/gtest.h>

#include <string>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

TEST(StopSignal, NotesInterruptAndTerminate) {
  for (const auto& [signal, name] : {std::pair(SIGINT, "SIGINT"), std::pair(SIGTERM, "SIGTERM")}) {
    const StopSignal stop;
    EXPECT_FALSE(stop.Requested());
    EXPECT_STREQ(stop.Name(), "");
    std::raise(signal);
    EXPECT_TRUE(stop.Requested());
    EXPECT_STREQ(stop.Name(), name);
  }
}

TEST(StopSignalDeathTest, SecondSignalKills) {
  EXPECT_EXIT(
      {
        const StopSignal stop;
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(StopSignalDeathTest, HandlersArePutBack) {
  EXPECT_EXIT(
      {
        { const StopSignal stop; }
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}

TEST(StopSignal, SecondObjectAtATimeIsABug) {
  const StopSignal stop;
  EXPECT_THROW(StopSignal(), CheckError);
}

}  // namespace
}  // namespace lift_slam
