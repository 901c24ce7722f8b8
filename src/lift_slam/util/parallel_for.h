#pragma once

#include <cstddef>
#include <functional>

namespace lift_slam {

// Calls work(0) to work(num_tasks - 1) on at most num_threads threads, the caller's included, and
// returns when all have ended. Which thread takes which task is open, so tasks write only to places
// of their own. The first exception (by number of task) is thrown on; tasks not begun are dropped.
void ParallelFor(std::size_t num_tasks, int num_threads,
                 const std::function<void(std::size_t)>& work);

}  // namespace lift_slam
