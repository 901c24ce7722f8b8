#pragma once

#include <functional>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/simulation/rendering/scene_renderer.h"

namespace lift_slam {

// What a camera sees at a pose; always the same for the same pose.
using ViewSource = std::function<RenderedView(const Rigid3d& cam_from_world)>;

// Makes a source for one thread; called and destroyed in that thread.
using ViewSourceFactory = std::function<ViewSource()>;

}  // namespace lift_slam
