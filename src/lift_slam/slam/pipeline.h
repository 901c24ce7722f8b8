#pragma once

#include <functional>
#include <optional>

#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/slam_system.h"

namespace lift_slam {

enum class RunMode { kSequential, kThreaded };

// How the stages of a run are tied together. `next_frame` hands out the input (nothing: end) and is
// called from one thread only; `frame_done` hears of every frame in order, in the calling thread,
// and returns false to end the run early.
struct PipelineCallbacks {
  std::function<std::optional<InputFrame>()> next_frame;
  std::function<bool(const FrameRecord&)> frame_done;
};

// Runs the input to its end. Sequential: everything in the calling thread. Threaded: reading and
// feature extraction of the next frames overlap with tracking and mapping of the present one; since
// mapping follows tracking in one thread (paper sec. 3.2), the result is the same to the bit.
// An exception of the reading thread is thrown here after the thread has ended.
void RunPipeline(RunMode mode, const PipelineCallbacks& callbacks, FramePreparer& preparer,
                 SlamSystem& system);

}  // namespace lift_slam
