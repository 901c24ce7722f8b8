#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {

// Numbers of several systems by category: a row a category, a dot a system.
struct DotSeries {
  // Instead of a number: drawn as a cross right of the frame, or not at all.
  static constexpr double kFailed = std::numeric_limits<double>::infinity();
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string label;  // legend
  PlotColor color = PlotColor::kBlue;
  std::vector<double> values;  // one for each category
  // Ends of a bar through the dot, such as least and largest; empty, or one for each category.
  std::vector<double> low = {}, high = {};
};

struct DotChart {
  std::string description;  // for screen readers
  PlotAxis axis;            // of the values, from 0 unless axis.min says else
  std::vector<std::string> categories;
  std::vector<DotSeries> series;
  int width_px = 560;
};

// An <svg> element in the style of RenderSvg; its colours come from PlotStyleSheet().
std::string RenderSvg(const DotChart& chart);
// The same as a file of its own, style sheet included.
std::string RenderSvgFile(const DotChart& chart);

}  // namespace lift_slam
