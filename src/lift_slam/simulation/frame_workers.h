#pragma once

#include <functional>

namespace lift_slam {

// What one thread does with a frame.
using FrameTask = std::function<void(int frame)>;

struct FrameWork {
  int num_frames = 0;
  int num_threads = 1;
  std::function<FrameTask()> make_task;  // called in each thread; the task also ends there
  std::function<void(int frames_done)> progress;
  std::function<bool()> stop;  // may be empty
};

// Hands the frames 0, 1, ... to threads in this order until all are done, `stop` says so or one
// throws; the exception of the lowest frame is then thrown here, after all threads have ended.
// `progress` is called in the calling thread. Returns the number of frames done.
int RunFrameWorkers(const FrameWork& work);

}  // namespace lift_slam
