#include "lift_slam/util/parallel_for.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace lift_slam {
namespace {

TEST(ParallelFor, DoesEveryTaskOnceForAnyNumberOfThreads) {
  for (const int threads : {-1, 1, 2, 7}) {
    std::vector<int> done(100);
    ParallelFor(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(100, 1));
  }
  ParallelFor(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, HandsOnAnException) {
  EXPECT_THROW(ParallelFor(50, 3,
                           [](std::size_t i) {
                             if (i == 20) throw std::runtime_error("20");
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace lift_slam
