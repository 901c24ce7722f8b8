#pragma once

#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/simulation/rendering/pinhole_view.h"

namespace lift_slam {

// Where a viewing ray meets a pinhole view.
struct LensSample {
  float x = 0.0F, y = 0.0F;  // in samples of the view
  int view = -1;             // index in LensMap::views; -1: the camera has no such ray
};

// How a camera with distortion gathers its picture from pinhole views: one wide view when all its
// rays lie within 60 degrees of the optical axis, else the faces of a cube that are needed. The
// views have at least as many samples as the picture everywhere.
struct LensMap {
  int width = 0, height = 0;  // of the camera's picture
  int samples_per_pixel = 1;  // supersampling squared
  std::vector<PinholeView> views;
  std::vector<LensSample> samples;  // height x width x samples_per_pixel, evenly in each pixel
  std::vector<LensSample> centers;  // height x width, the pixels' centres
};

// Throws InputError when the camera has no valid ray at all.
LensMap MakeLensMap(const Camera& camera, int supersampling);

}  // namespace lift_slam
