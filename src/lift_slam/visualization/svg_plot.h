#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lift_slam {

// Colours after Okabe and Ito (told apart with any colour vision); the style sheet gives each a
// tone for light and for dark pages. kInk is that of the text, kGray that of ground truth: wide,
// under the estimate.
enum class PlotColor { kInk, kBlue, kVermilion, kGreen, kOrange, kSky, kPurple, kGray };
constexpr int kNumPlotColors = 8;

enum class SeriesKind {
  kLine,
  kPoints,       // filled circles
  kRings,        // open circles
  kStackedBars,  // all such series of a plot share x and stand on one another, in order
  kRug,          // short strokes on the x axis; y is not used
};

struct PlotSeries {
  std::string label;  // legend; empty: not in the legend
  SeriesKind kind = SeriesKind::kLine;
  PlotColor color = PlotColor::kBlue;
  std::vector<double> x, y;  // data units; a value that is not finite interrupts a line
  double size_px = 1.6;      // line width or circle diameter
};

// A stretch of the x axis in some state: a strip on the frame's top edge and, if asked for, a tint.
struct PlotBand {
  std::string label;
  PlotColor color = PlotColor::kOrange;
  double x_begin = 0.0, x_end = 0.0;  // data units
  bool tinted = true;
};

// A dashed horizontal line.
struct PlotLevel {
  std::string label;
  PlotColor color = PlotColor::kInk;
  double y = 0.0;
};

// A picture under the series, its corners in data units.
struct PlotImage {
  std::string data_uri;
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;
};

struct PlotAxis {
  std::string label;               // with the unit: "time [s]"
  bool integers = false;           // ticks at whole numbers only
  std::optional<double> min, max;  // instead of the data's
};

// A plot with axes, ticks, grid and a legend above the frame; nothing ever covers the data.
struct Plot {
  std::string description;  // for screen readers
  PlotAxis x, y;
  bool equal_aspect = false;  // one unit has the same length on both axes
  int width_px = 560, height_px = 300;
  std::vector<PlotImage> images;
  std::vector<PlotBand> bands;
  std::vector<PlotLevel> levels;
  std::vector<PlotSeries> series;
};

// An <svg> element. Its colours come from PlotStyleSheet(), which the page has to include once.
std::string RenderSvg(const Plot& plot);
// The same as a file of its own, style sheet included.
std::string RenderSvgFile(const Plot& plot);
// CSS for all plots of a page, with tones for light, dark and print.
std::string PlotStyleSheet();

}  // namespace lift_slam
