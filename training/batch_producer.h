#pragma once

#include <cstdint>
#include <thread>

#include "lift_slam/util/blocking_queue.h"
#include "training/patch_sampler.h"

namespace lift_slam::training {

// Draws the batches of a run ahead of it, in a thread of its own.
class BatchProducer {
 public:
  // From batch `first` on. The sampler must outlive the producer.
  BatchProducer(const PatchSampler& sampler, std::uint64_t first);
  ~BatchProducer();
  BatchProducer(const BatchProducer&) = delete;
  BatchProducer& operator=(const BatchProducer&) = delete;

  // The next batch; waits for it. What the drawing threw is thrown here.
  PatchBatch Next();

 private:
  static constexpr std::size_t kAhead = 4;
  BlockingQueue<PatchBatch> queue_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace lift_slam::training
