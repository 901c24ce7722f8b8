#include "lift_slam/simulation/scene_watch.h"

#include <fmt/format.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

std::string Place(const Eigen::Vector3d& position) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) m", position.x(), position.y(), position.z());
}

}  // namespace

void CheckInsideScene(const std::vector<Rigid3d>& world_from_cam, const Eigen::AlignedBox3d& box) {
  for (std::size_t i = 0; i < world_from_cam.size(); ++i) {
    if (box.contains(world_from_cam[i].translation)) continue;
    throw InputError(fmt::format(
        "the camera's path leaves the scene: frame {} is at {}, the scene reaches from {} to {}", i,
        Place(world_from_cam[i].translation), Place(box.min()), Place(box.max())));
  }
}

EmptyFrameWatch::EmptyFrameWatch(const std::vector<Rigid3d>& world_from_cam)
    : world_from_cam_(world_from_cam), contents_(world_from_cam.size(), Content::kUnknown) {}

void EmptyFrameWatch::Tell(int frame, bool is_empty) {
  const std::lock_guard lock(mutex_);
  contents_[static_cast<std::size_t>(frame)] = is_empty ? Content::kEmpty : Content::kSomething;
  for (; next_ < contents_.size() && contents_[next_] != Content::kUnknown; ++next_) {
    empty_in_a_row_ = contents_[next_] == Content::kEmpty ? empty_in_a_row_ + 1 : 0;
    if (empty_in_a_row_ < kMaxEmptyInARow) continue;
    const std::size_t first = next_ + 1 - static_cast<std::size_t>(kMaxEmptyInARow);
    throw InputError(
        fmt::format("the camera's path leaves the scene: from frame {} at {} on, {} frames in a "
                    "row show nothing but sky",
                    first, Place(world_from_cam_[first].translation), kMaxEmptyInARow));
  }
}

}  // namespace lift_slam
