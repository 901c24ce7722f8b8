#include "lift_slam/simulation/frame_workers.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace lift_slam {
namespace {

class Workers {
 public:
  explicit Workers(const FrameWork& work) : work_(work) {}

  int Run() {
    const int count = std::max(1, std::min(work_.num_threads, work_.num_frames));
    active_ = count;
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back([this] { Work(); });
    ReportUntilAllEnded();
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
    return done_;
  }

 private:
  void Work() {
    int frame = -1;  // an exception before the first frame is the most important
    try {
      const FrameTask task = work_.make_task();
      for (frame = TakeFrame(); frame < work_.num_frames; frame = TakeFrame()) {
        task(frame);
        const std::lock_guard lock(mutex_);
        ++done_;
        changed_.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (frame < error_frame_) {
        error_frame_ = frame;
        error_ = std::current_exception();
      }
    }
    const std::lock_guard lock(mutex_);
    --active_;
    changed_.notify_one();
  }

  // The next frame; num_frames when there is none or it is time to end.
  int TakeFrame() {
    const bool stop = work_.stop && work_.stop();
    const std::lock_guard lock(mutex_);
    if (stop || error_) return work_.num_frames;
    return next_ < work_.num_frames ? next_++ : work_.num_frames;
  }

  void ReportUntilAllEnded() {
    std::unique_lock lock(mutex_);
    for (int told = -1; active_ > 0;) {
      changed_.wait_for(lock, std::chrono::milliseconds(200));
      if (done_ == told || !work_.progress) continue;
      told = done_;
      lock.unlock();
      work_.progress(told);
      lock.lock();
    }
  }

  const FrameWork& work_;
  std::mutex mutex_;  // of everything below
  std::condition_variable changed_;
  int next_ = 0, done_ = 0, active_ = 0;
  int error_frame_ = std::numeric_limits<int>::max();
  std::exception_ptr error_;
};

}  // namespace

int RunFrameWorkers(const FrameWork& work) { return Workers(work).Run(); }

}  // namespace lift_slam
