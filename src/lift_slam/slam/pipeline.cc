#include "lift_slam/slam/pipeline.h"

#include <exception>
#include <thread>

#include "lift_slam/util/blocking_queue.h"

namespace lift_slam {
namespace {

// Frames prepared ahead; each holds an image and its features.
constexpr std::size_t kFramesAhead = 4;

void RunSequential(const PipelineCallbacks& callbacks, FramePreparer& preparer,
                   SlamSystem& system) {
  while (auto input = callbacks.next_frame()) {
    if (!callbacks.frame_done(system.Process(preparer.Prepare(std::move(*input))))) return;
  }
}

// Prepares frames in a thread of its own; closes the queue at the end, whatever the reason.
class PreparingThread {
 public:
  PreparingThread(const PipelineCallbacks& callbacks, FramePreparer& preparer)
      : queue_(kFramesAhead), thread_([&] { Run(callbacks, preparer); }) {}
  ~PreparingThread() {
    queue_.Close();
    if (thread_.joinable()) thread_.join();
  }

  std::optional<PreparedFrame> Next() { return queue_.Pop(); }
  // Waits for the end and passes on what went wrong.
  void Finish() {
    queue_.Close();
    thread_.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void Run(const PipelineCallbacks& callbacks, FramePreparer& preparer) {
    try {
      while (auto input = callbacks.next_frame()) {
        if (!queue_.Push(preparer.Prepare(std::move(*input)))) break;
      }
    } catch (...) {
      error_ = std::current_exception();
    }
    queue_.Close();
  }

  BlockingQueue<PreparedFrame> queue_;
  std::exception_ptr error_;  // written by the thread, read after it has been joined
  std::thread thread_;
};

void RunThreaded(const PipelineCallbacks& callbacks, FramePreparer& preparer, SlamSystem& system) {
  PreparingThread preparing(callbacks, preparer);
  while (auto prepared = preparing.Next()) {
    if (!callbacks.frame_done(system.Process(*prepared))) break;
  }
  preparing.Finish();
}

}  // namespace

void RunPipeline(RunMode mode, const PipelineCallbacks& callbacks, FramePreparer& preparer,
                 SlamSystem& system) {
  if (mode == RunMode::kSequential) {
    RunSequential(callbacks, preparer, system);
  } else {
    RunThreaded(callbacks, preparer, system);
  }
}

}  // namespace lift_slam
