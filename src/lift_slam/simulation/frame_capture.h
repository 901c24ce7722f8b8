#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lift_slam/simulation/light_image.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/simulation/sensor_options.h"
#include "lift_slam/simulation/view_source.h"

namespace lift_slam {

// One frame of a simulated camera.
struct CapturedFrame {
  ByteImage gray;
  std::optional<ByteImage> color;
  std::vector<float>
      depth_m;  // as RenderedView::depth_m; with a rolling shutter of each row's pose
};

// What the sensor sees of a motion at a time; `frame` and `seed` are of its noise. The pose at
// `time_s` is that of the image's middle row in the middle of the exposure. Without effects the
// view's own pixels.
CapturedFrame CaptureFrame(const ViewSource& view_source, const CameraMotion& motion,
                           const SensorOptions& options, ImageColor color, std::uint64_t seed,
                           int frame, double time_s);

}  // namespace lift_slam
