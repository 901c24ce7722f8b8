#include "training/batch_producer.h"

#include <exception>
#include <utility>

#include "lift_slam/util/check.h"

namespace lift_slam::training {

BatchProducer::BatchProducer(const PatchSampler& sampler, std::uint64_t first)
    : queue_(kAhead), thread_([this, &sampler, first] {
        try {
          for (std::uint64_t i = first; queue_.Push(sampler.Draw(i)); ++i) {
          }
        } catch (...) {
          failure_ = std::current_exception();
          queue_.Close();
        }
      }) {}

BatchProducer::~BatchProducer() {
  queue_.Close();
  thread_.join();
}

PatchBatch BatchProducer::Next() {
  std::optional<PatchBatch> batch = queue_.Pop();
  if (!batch && failure_) std::rethrow_exception(failure_);
  LIFT_SLAM_CHECK(batch.has_value(), "no batch although nobody closed the queue");
  return std::move(*batch);
}

}  // namespace lift_slam::training
