#pragma once

#include <vector>

#include "lift_slam/image/image.h"

namespace lift_slam {

// One level of a pyramid. Coordinates are pixels with (0, 0) at the CENTRE of the top-left pixel.
struct PyramidLevel {
  GrayImage image;
  // Full-size pixels per pixel of this level, >= 1. Exact: the ratio of the sizes, which rounding
  // makes differ slightly between x and y and from scale_factor^level.
  double scale_x = 1.0, scale_y = 1.0;

  double FullX(double x) const { return (x + 0.5) * scale_x - 0.5; }
  double FullY(double y) const { return (y + 0.5) * scale_y - 0.5; }
};

// Level 0 is the image itself (pixels shared); each next level is smaller.
using ImagePyramid = std::vector<PyramidLevel>;

struct PyramidShape {
  int num_levels = 8;
  double scale_factor = 1.2;  // > 1, between neighbouring levels
  int min_size_px = 1;        // a level whose width or height is below this ends the pyramid
};

// At most shape.num_levels levels, none for an empty image. Each is resampled bilinearly from the
// one before it. The same bytes for any number of OpenCV threads.
ImagePyramid BuildPyramid(const GrayImage& image, const PyramidShape& shape);

// The same in place of an old pyramid, whose levels above 0 are written over where their size
// fits: for the frames of a sequence, where new memory would cost more than the resampling.
// Nobody else may hold images of the old pyramid's levels above 0.
void RebuildPyramid(const GrayImage& image, const PyramidShape& shape, ImagePyramid& pyramid);

}  // namespace lift_slam
