#include "lift_slam/datasets/prefetching_sequence.h"

#include <utility>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

std::unique_ptr<Sequence> RequireSequence(std::unique_ptr<Sequence> sequence) {
  LIFT_SLAM_CHECK(sequence != nullptr, "no sequence to read ahead");
  return sequence;
}

}  // namespace

PrefetchingSequence::PrefetchingSequence(std::unique_ptr<Sequence> inner, std::size_t num_ahead)
    : inner_(RequireSequence(std::move(inner))),
      info_(inner_->info()),
      frames_(std::max<std::size_t>(1, num_ahead)),
      worker_([this] { Run(); }) {}

PrefetchingSequence::~PrefetchingSequence() {
  frames_.Close();
  worker_.join();
}

void PrefetchingSequence::Run() {
  try {
    while (std::optional<SequenceFrame> frame = inner_->Next()) {
      if (!frames_.Push(std::move(*frame))) return;
    }
  } catch (...) {
    error_ = std::current_exception();
  }
  frames_.Close();
}

std::optional<SequenceFrame> PrefetchingSequence::Next() {
  std::optional<SequenceFrame> frame = frames_.Pop();
  if (!frame && error_) std::rethrow_exception(error_);
  return frame;
}

}  // namespace lift_slam
