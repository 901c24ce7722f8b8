#include "lift_slam/nn/worker_team.h"

#include <utility>

#include "lift_slam/util/check.h"

// libgomp, which oneDNN is linked with; declared here since <omp.h> is the compiler's own, and a
// second OpenMP runtime (clang's) must not come in.
extern "C" {
int omp_get_max_threads(void);
void omp_set_num_threads(int);
}

namespace lift_slam::nn {

SingleOpenMpThread::SingleOpenMpThread() : previous_(omp_get_max_threads()) {
  omp_set_num_threads(1);
}
SingleOpenMpThread::~SingleOpenMpThread() { omp_set_num_threads(previous_); }

WorkerTeam::WorkerTeam(int num_threads) {
  LIFT_SLAM_CHECK(num_threads >= 1, "a team of {} threads", num_threads);
  for (int worker = 1; worker < num_threads; ++worker) {
    threads_.emplace_back([this, worker] { ThreadMain(worker); });
  }
}

WorkerTeam::~WorkerTeam() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerTeam::ForEach(int num_pieces, const std::function<void(int, int)>& work) {
  std::unique_lock<std::mutex> lock(mutex_);
  LIFT_SLAM_CHECK(work_ == nullptr, "the team is at work already");
  work_ = &work;
  next_piece_ = 0;
  num_pieces_ = num_pieces;
  if (num_pieces > 1) work_ready_.notify_all();
  TakePieces(0, lock);
  work_done_.wait(lock, [this] { return num_busy_ == 0; });
  work_ = nullptr;
  num_pieces_ = 0;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WorkerTeam::ThreadMain(int worker) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    work_ready_.wait(lock, [this] { return stop_ || next_piece_ < num_pieces_; });
    if (stop_) return;
    TakePieces(worker, lock);
  }
}

void WorkerTeam::TakePieces(int worker, std::unique_lock<std::mutex>& lock) {
  while (next_piece_ < num_pieces_) {
    const int piece = next_piece_++;
    const auto& work = *work_;
    ++num_busy_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      work(worker, piece);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) {
      if (!failure_) failure_ = failure;
      next_piece_ = num_pieces_;  // the rest is not worth doing
    }
    if (--num_busy_ == 0) work_done_.notify_all();
  }
}

}  // namespace lift_slam::nn
