#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <thread>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/util/blocking_queue.h"

namespace lift_slam {

// Hands out the frames of another sequence, decoded ahead of use by a background thread: the same
// frames in the same order. An exception of the inner sequence comes out of Next once the frames
// before it are used up. The destructor waits for the image being decoded, at most.
class PrefetchingSequence : public Sequence {
 public:
  // `num_ahead` (>= 1) frames are kept ready; an image of 1241 x 376 pixels takes 0.5 MB.
  explicit PrefetchingSequence(std::unique_ptr<Sequence> inner, std::size_t num_ahead = 4);
  ~PrefetchingSequence() override;
  PrefetchingSequence(const PrefetchingSequence&) = delete;
  PrefetchingSequence& operator=(const PrefetchingSequence&) = delete;

  std::optional<SequenceFrame> Next() override;
  const SequenceInfo& info() const override { return info_; }

 private:
  void Run();

  const std::unique_ptr<Sequence> inner_;  // used by the worker alone
  const SequenceInfo info_;
  BlockingQueue<SequenceFrame> frames_;
  std::exception_ptr error_;  // written before the queue is closed, read after it has run dry
  std::thread worker_;        // last, so that it starts with all else in place
};

}  // namespace lift_slam
