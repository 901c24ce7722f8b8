#pragma once

#include <string>
#include <vector>

#include "lift_slam/visualization/axis.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {

// An entry of the legend, placed.
struct LegendItem {
  enum class Swatch { kLine, kDashed, kPoint, kRing, kBar, kTick };
  std::string label;
  PlotColor color = PlotColor::kInk;
  Swatch swatch = Swatch::kLine;
  double x = 0.0, y = 0.0;  // left end and middle of the line, pixels
};

// Where everything of a plot goes: the frame in pixels and the ranges it shows.
struct PlotLayout {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;  // frame, pixels
  AxisRange x_range, y_range;                               // data units
  AxisTicks x_ticks, y_ticks;
  std::vector<LegendItem> legend;

  double X(double x) const { return left + (x - x_range.min) / x_range.length() * width; }
  double Y(double y) const { return top + height - (y - y_range.min) / y_range.length() * height; }
};

PlotLayout LayOut(const Plot& plot);

// Width of a text in the plots' font (12 px), estimated from its characters.
double TextWidth(const std::string& text);

}  // namespace lift_slam
