#pragma once

// View sources for tests, without OpenGL.
#include <atomic>
#include <cmath>
#include <memory>

#include "lift_slam/camera/camera.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/simulation/view_source.h"

namespace lift_slam {

inline Camera TestCamera() {
  Camera camera;
  camera.pinhole = {40.0, 40.0, 31.5, 23.5, 64, 48};
  camera.frame_rate_hz = 10.0;
  camera.source = "test";
  return camera;
}

// Forward along z at 1 m/s, for 2 s, camera axes as the world's.
class StraightMotion : public CameraMotion {
 public:
  Rigid3d WorldFromCam(double time_s) const override {
    return {Eigen::Quaterniond::Identity(), {0.0, 0.0, std::clamp(time_s, 0.0, 2.0)}};
  }
  double DurationS() const override { return 2.0; }
};

// A wall at z = 10 m whose red is the camera's z in centimetres, in every pixel; green 50 in the
// upper half, 200 in the lower; blue 0.
inline RenderedView WallView(const Rigid3d& cam_from_world) {
  const double z = cam_from_world.TargetOriginInSource().z();
  RenderedView view{64, 48, {}, {}};
  for (int i = 0; i < 64 * 48; ++i) {
    view.rgb.push_back(static_cast<std::uint8_t>(std::lround(100.0 * z)));
    view.rgb.push_back(i < 64 * 24 ? 50 : 200);
    view.rgb.push_back(0);
    view.depth_m.push_back(static_cast<float>(10.0 - z));
  }
  return view;
}

// Nothing but sky.
inline RenderedView SkyView(const Rigid3d&) {
  RenderedView view{64, 48, {}, {}};
  view.rgb.assign(std::size_t{3} * 64 * 48, 200);
  view.depth_m.assign(std::size_t{64} * 48, 0.0F);
  return view;
}

}  // namespace lift_slam
