#pragma once

#include <string>
#include <vector>

namespace lift_slam {

// A line in pixel coordinates; a point that is not finite interrupts it.
struct PixelLine {
  std::vector<double> x, y;
};

// Fewer points, the same picture: where x never decreases, only the first, lowest, highest and last
// point of each pixel column stay (so peaks survive); elsewhere points closer than `tolerance_px`
// to the one before go. Of what is left, points go that the line through the others passes within a
// tenth of a pixel. Gaps stay gaps.
PixelLine ThinnedOut(const PixelLine& line, double tolerance_px = 0.7);

// The `d` attribute of an SVG path, with a tenth of a pixel; a single point between gaps becomes a
// dot (a stroke of no length, visible with round caps).
std::string SvgPathData(const PixelLine& line);

}  // namespace lift_slam
