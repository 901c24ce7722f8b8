#pragma once

#include <Eigen/Geometry>
#include <mutex>
#include <vector>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// Throws InputError naming the first frame whose camera is outside the box, and where it is.
void CheckInsideScene(const std::vector<Rigid3d>& world_from_cam, const Eigen::AlignedBox3d& box);

// Hears of every frame whether it shows anything, in any order and from any thread.
class EmptyFrameWatch {
 public:
  // This many frames in a row with nothing but sky are a camera that has left the scene.
  static constexpr int kMaxEmptyInARow = 15;

  explicit EmptyFrameWatch(const std::vector<Rigid3d>& world_from_cam);

  // Throws InputError when this completes a row of too many empty frames, counted over the frames
  // from the first on that are known without a gap.
  void Tell(int frame, bool is_empty);

 private:
  enum class Content : char { kUnknown, kEmpty, kSomething };

  const std::vector<Rigid3d>& world_from_cam_;
  std::mutex mutex_;
  std::vector<Content> contents_;
  std::size_t next_ = 0;  // all before are known
  int empty_in_a_row_ = 0;
};

}  // namespace lift_slam
