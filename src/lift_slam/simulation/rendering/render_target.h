#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/simulation/rendering/gl_objects.h"

namespace lift_slam {

// What one view's drawing leaves: row 0 at the top.
struct Samples {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<float> depth;  // of the depth buffer, see DepthRange
};

// A picture in OpenGL's hands to draw into, with a depth buffer of floats.
class RenderTarget {
 public:
  // Throws InputError when OpenGL allows no picture of this size.
  RenderTarget(int width, int height);

  // Chooses the top-left width x height samples to be drawn to, and clears them (depth: far).
  void Begin(int width, int height) const;
  // Copies what was drawn since Begin().
  void Read(Samples& samples) const;

 private:
  GlRenderbuffer color_, depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace lift_slam
