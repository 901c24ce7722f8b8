#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/simulation/rendering/pinhole_view.h"
#include "lift_slam/simulation/rendering/scene_chunks.h"

namespace lift_slam {

// Where a view looks from and to.
struct ViewPose {
  Eigen::Matrix3d cam_from_scene;  // rotation
  Eigen::Vector3d eye;             // the camera centre in the scene
};

// Indices of the chunks that may be seen (box touches the view's pyramid), in the order to draw:
// opaque before alpha-tested, in shells of distance from near to far, in a shell by appearance.
std::vector<int> VisibleChunks(const ChunkedScene& scene, const PinholeView& view,
                               const ViewPose& pose, const DepthRange& range);

}  // namespace lift_slam
