#pragma once

#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/loop_closing/spanning_tree.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

struct LoopBundleReport {
  int keyframes = 0, points = 0, observations = 0;
  int outliers = 0;  // observations taken out of the map
  // By keyframe id (also of erased ones): factor of all lengths in the keyframe's camera frame.
  std::vector<double> scale_of_keyframe;
  double solve_ms = 0.0;  // in its own thread
  double wait_ms = 0.0;   // for it, at the merge
  double merge_ms = 0.0;
};

// Bundle adjustment of the whole map after a loop (ORB-SLAM sec. VII-E), beside tracking and
// mapping: a thread of its own works on a copy of poses, points and observations. A fixed number of
// keyframes later its result is merged by the map's one owner, who waits for it if need be: so
// the result does not depend on speed, and the map needs no lock. Keyframes made meanwhile follow
// their parents in the spanning tree, points made meanwhile their oldest observers.
class LoopBundle {
 public:
  explicit LoopBundle(const LoopBundleOptions& options) : options_(options) {}

  // Copies the map's state and begins. One that is running is waited for and forgotten.
  void Begin(const Map& map);
  // Waits for what is running and forgets it: the map has been changed as a whole.
  void GiveUp() { running_.reset(); }
  bool is_running() const { return running_ != nullptr; }

  // Call for each new keyframe that `tree` has. Merges when it is time; nothing before that, and
  // when the adjustment failed.
  std::optional<LoopBundleReport> KeyFrameAdded(const SpanningTree& tree, Map& map);

 private:
  struct Running;
  struct Forget {
    void operator()(Running* running) const;
  };

  LoopBundleOptions options_;
  std::unique_ptr<Running, Forget> running_;
};

}  // namespace lift_slam
