#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/image/image.h"
#include "lift_slam/testing/textured_world.h"

namespace lift_slam {

struct PictureOptions {
  double noise_gray = 1.5;  // standard deviation of the noise of each pixel, grey values
  double exposure = 1.0;    // factor on all grey values before the noise
  std::uint64_t noise_seed = 1;
};

// Renders textured rectangles through any camera model: one ray a pixel, the nearest rectangle,
// its texture averaged over the pixel's footprint. One thread; about 10 ms for 640 x 480.
class Renderer {
 public:
  // Unprojects every pixel once. Pixels without a ray stay black.
  explicit Renderer(const Camera& camera);

  GrayImage Render(const TexturedWorld& world, const Rigid3d& cam_from_world,
                   const PictureOptions& options) const;

 private:
  // Rays of a block of pixels lie in this box of the plane z = 1.
  struct Tile {
    int x = 0, y = 0;  // first pixel
    Eigen::Vector2f low, high;
  };

  void MakeTiles();

  int width_ = 0, height_ = 0;
  Eigen::Vector2f pixel_size_;         // of a pixel in the plane z = 1, in the image centre
  std::vector<Eigen::Vector2f> rays_;  // row by row: x / z, y / z; NaN where there is none
  std::vector<Tile> tiles_;
  Eigen::Vector2f low_ = Eigen::Vector2f::Constant(1e9F);  // box of all rays
  Eigen::Vector2f high_ = Eigen::Vector2f::Constant(-1e9F);
};

}  // namespace lift_slam
