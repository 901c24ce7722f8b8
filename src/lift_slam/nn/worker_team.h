#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace lift_slam::nn {

// Threads that share out numbered pieces of work. THE THREADING POLICY OF nn/: every piece (a few
// samples of a batch, a strip of an image) is computed by one thread from beginning to end, and
// libraries underneath run on that thread alone (SingleOpenMpThread). So
//  - a program runs exactly the threads it asked for: `num_threads` counts the caller, and OpenMP
//    never starts its own,
//  - a result does not depend on the number of threads, nor on which of them did what,
//  - threads never wait for one another inside a network.
class WorkerTeam {
 public:
  explicit WorkerTeam(int num_threads);  // >= 1; starts num_threads - 1
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  int num_threads() const { return static_cast<int>(threads_.size()) + 1; }

  // Calls work(worker, piece) once for each piece in [0, num_pieces), worker in [0, num_threads);
  // the caller is worker 0. Returns when all are done; an exception of a piece is thrown on, after
  // the others have ended. One caller at a time; not from within work().
  void ForEach(int num_pieces, const std::function<void(int worker, int piece)>& work);

 private:
  void ThreadMain(int worker);
  void TakePieces(int worker, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;  // guards all below
  std::condition_variable work_ready_, work_done_;
  const std::function<void(int, int)>* work_ = nullptr;
  int next_piece_ = 0, num_pieces_ = 0, num_busy_ = 0;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

// While it lives, OpenMP regions that this thread starts have one thread.
class SingleOpenMpThread {
 public:
  SingleOpenMpThread();
  ~SingleOpenMpThread();
  SingleOpenMpThread(const SingleOpenMpThread&) = delete;
  SingleOpenMpThread& operator=(const SingleOpenMpThread&) = delete;

 private:
  int previous_;
};

}  // namespace lift_slam::nn
