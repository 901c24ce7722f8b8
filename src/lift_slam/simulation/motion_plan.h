#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/simulation/render_options.h"
#include "lift_slam/simulation/scene/road.h"
#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// A motion and the times at which frames are taken of it.
struct MotionPlan {
  std::shared_ptr<const CameraMotion> motion;
  std::vector<std::int64_t> times_ns;
  std::string description;  // a line for the user: what moves, how far, how long
};

// The motion that the options ask for. `road` is empty when the scene has none, and `no_road` then
// says why. Recorded poses are frames at their own times. Throws InputError when the motion cannot
// be had or no frame is left.
MotionPlan PlanMotion(const RenderOptions& options, const std::optional<Road>& road,
                      const std::string& no_road, const Eigen::AlignedBox3d& scene_box);

// Where a camera may be: the box of all vertices and a margin about it.
Eigen::AlignedBox3d SceneBox(const Scene& scene);  // of the vertices alone
Eigen::AlignedBox3d RoomForCamera(const Eigen::AlignedBox3d& scene_box);

}  // namespace lift_slam
