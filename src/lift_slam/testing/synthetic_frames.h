#pragma once

#include <array>
#include <memory>
#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

// Frames of a made-up scene without images: feature i of each frame is point i as the camera sees
// it, with a random binary descriptor of its own of which a few bits differ from frame to frame.
// Points outside the image keep their place in the list and are never matched by position.
class SyntheticFrames {
 public:
  // `depth_range`: of the points before a camera at the world's origin.
  SyntheticFrames(int num_points, double min_depth, double max_depth, std::uint64_t seed);

  const std::shared_ptr<const ViewModel>& view() const { return view_; }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  // A frame with this true pose (set in the frame); pixels carry noise of sigma_px.
  Frame MakeFrame(std::int64_t index, const Rigid3d& cam_from_world, double sigma_px = 0.0);

  // Adds keyframes with these poses, which see all points, and the points themselves; the point
  // ids come in the order of points().
  std::vector<MapPointId> FillMap(const std::vector<Rigid3d>& cams_from_world, Map& map);

 private:
  Random random_;
  std::shared_ptr<const ViewModel> view_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint64_t, 4>> descriptors_;
};

}  // namespace lift_slam
