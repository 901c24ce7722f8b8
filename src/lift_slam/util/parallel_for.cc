#include "lift_slam/util/parallel_for.h"

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace lift_slam {
namespace {

class Loop {
 public:
  Loop(std::size_t num_tasks, const std::function<void(std::size_t)>& work)
      : num_tasks_(num_tasks), work_(work) {}

  void TakeTasks() {
    for (std::size_t task = next_++; task < num_tasks_ && !has_failed_; task = next_++) {
      try {
        work_(task);
      } catch (...) {
        Fail(task, std::current_exception());
      }
    }
  }

  void Rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void Fail(std::size_t task, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    has_failed_ = true;
    if (task >= failed_task_) return;
    failed_task_ = task;
    error_ = std::move(error);
  }

  const std::size_t num_tasks_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> has_failed_ = false;
  std::mutex mutex_;  // guards the two below
  std::size_t failed_task_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

}  // namespace

void ParallelFor(std::size_t num_tasks, int num_threads,
                 const std::function<void(std::size_t)>& work) {
  Loop loop(num_tasks, work);
  {
    std::vector<std::jthread> helpers;
    const std::size_t wanted = num_threads > 1 ? static_cast<std::size_t>(num_threads) : 1;
    for (std::size_t i = 1; i < std::min(wanted, num_tasks); ++i) {
      helpers.emplace_back([&loop] { loop.TakeTasks(); });
    }
    loop.TakeTasks();
  }
  loop.Rethrow();
}

}  // namespace lift_slam
