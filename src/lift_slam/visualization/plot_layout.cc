#include "lift_slam/visualization/plot_layout.h"

#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

constexpr double kLegendRow = 20.0;
constexpr double kSwatchWidth = 22.0;
constexpr double kLegendGap = 18.0;
constexpr double kXTickSpacing = 72.0;  // pixels between ticks, about
constexpr double kYTickSpacing = 40.0;

LegendItem::Swatch SwatchOf(SeriesKind kind) {
  switch (kind) {
    case SeriesKind::kLine:
      return LegendItem::Swatch::kLine;
    case SeriesKind::kPoints:
      return LegendItem::Swatch::kPoint;
    case SeriesKind::kRings:
      return LegendItem::Swatch::kRing;
    case SeriesKind::kStackedBars:
      return LegendItem::Swatch::kBar;
    case SeriesKind::kRug:
      return LegendItem::Swatch::kTick;
  }
  return LegendItem::Swatch::kLine;
}

// Each label once, in the order of the plot.
std::vector<LegendItem> LegendEntries(const Plot& plot) {
  std::vector<LegendItem> items;
  const auto add = [&](const std::string& label, PlotColor color, LegendItem::Swatch swatch) {
    const bool known = std::any_of(items.begin(), items.end(),
                                   [&](const LegendItem& item) { return item.label == label; });
    if (!label.empty() && !known) items.push_back({label, color, swatch});
  };
  for (const PlotSeries& s : plot.series) add(s.label, s.color, SwatchOf(s.kind));
  for (const PlotLevel& l : plot.levels) add(l.label, l.color, LegendItem::Swatch::kDashed);
  for (const PlotBand& b : plot.bands) add(b.label, b.color, LegendItem::Swatch::kBar);
  return items;
}

// Gives the entries their places, row by row; returns the number of rows.
int PlaceLegend(double left, double right, std::vector<LegendItem>& items) {
  double x = left;
  int row = 0;
  for (LegendItem& item : items) {
    const double width = kSwatchWidth + TextWidth(item.label);
    if (x > left && x + width > right) {
      x = left;
      ++row;
    }
    item.x = x;
    item.y = 10.0 + kLegendRow * row;
    x += width + kLegendGap;
  }
  return items.empty() ? 0 : row + 1;
}

// Sums of the stacked bars, which the y axis must hold.
void AddStackedTops(const Plot& plot, AxisRange& range) {
  std::vector<double> top;
  for (const PlotSeries& s : plot.series) {
    if (s.kind != SeriesKind::kStackedBars) continue;
    top.resize(std::max(top.size(), s.y.size()), 0.0);
    for (std::size_t i = 0; i < s.y.size(); ++i) top[i] += std::isfinite(s.y[i]) ? s.y[i] : 0.0;
  }
  range.Add(top);
  if (!top.empty()) range.Add(0.0);
}

void DataRanges(const Plot& plot, AxisRange& x, AxisRange& y) {
  for (const PlotSeries& s : plot.series) {
    x.Add(s.x);
    if (s.kind != SeriesKind::kRug && s.kind != SeriesKind::kStackedBars) y.Add(s.y);
  }
  AddStackedTops(plot, y);
  for (const PlotImage& image : plot.images) {
    for (const double v : {image.x_min, image.x_max}) x.Add(v);
    for (const double v : {image.y_min, image.y_max}) y.Add(v);
  }
  for (const PlotBand& band : plot.bands) {
    for (const double v : {band.x_begin, band.x_end}) x.Add(v);
  }
  for (const PlotLevel& level : plot.levels) y.Add(level.y);
}

AxisRange Fixed(const PlotAxis& axis, AxisRange range) {
  if (axis.min || axis.max) range = WithLength(range);
  if (axis.min) range.min = *axis.min;
  if (axis.max) range.max = *axis.max;
  return WithLength(range);
}

// Grows the shorter axis about its middle until both have the same units per pixel.
void MakeEqualAspect(PlotLayout& layout) {
  AxisRange& x = layout.x_range;
  AxisRange& y = layout.y_range;
  const double unit_per_px = std::max(x.length() / layout.width, y.length() / layout.height);
  const auto grow = [&](AxisRange& range, double pixels) {
    const double middle = 0.5 * (range.min + range.max), half = 0.5 * unit_per_px * pixels;
    range = {middle - half, middle + half, false};
  };
  grow(x, layout.width);
  grow(y, layout.height);
}

void ChooseRanges(const Plot& plot, PlotLayout& layout) {
  AxisRange x, y;
  DataRanges(plot, x, y);
  layout.x_range = Fixed(plot.x, x);
  layout.y_range = Fixed(plot.y, y);
  if (plot.equal_aspect) {
    for (AxisRange* range : {&layout.x_range, &layout.y_range}) {
      const double margin = plot.images.empty() ? 0.06 * range->length() : 0.0;
      *range = {range->min - margin, range->max + margin, false};
    }
    return;
  }
  const AxisRange grown =
      GrownToTicks(layout.y_range, static_cast<int>(layout.height / kYTickSpacing) + 1);
  if (!plot.y.min) layout.y_range.min = grown.min;
  if (!plot.y.max) layout.y_range.max = grown.max;
}

int TickCount(double length_px, double spacing_px) {
  return std::max(2, static_cast<int>(length_px / spacing_px) + 1);
}

}  // namespace

double TextWidth(const std::string& text) {
  double width = 0.0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // inside a UTF-8 sequence
    const bool narrow = std::string_view(" .,:;'|!ijltfr()[]").find(c) != std::string_view::npos;
    const bool wide = std::string_view("mwMWABCDGHNOQRU%").find(c) != std::string_view::npos;
    width += narrow ? 3.8 : wide ? 9.6 : 7.0;
  }
  return width;
}

PlotLayout LayOut(const Plot& plot) {
  PlotLayout layout;
  layout.legend = LegendEntries(plot);
  const double right = plot.width_px - 14.0;
  layout.left = 64.0;
  layout.width = right - layout.left;
  const int rows = PlaceLegend(layout.left, right, layout.legend);
  layout.top = rows > 0 ? rows * kLegendRow + 8.0 : 10.0;
  if (!plot.bands.empty()) layout.top += 6.0;
  layout.height = plot.height_px - layout.top - 44.0;
  ChooseRanges(plot, layout);
  if (plot.equal_aspect) MakeEqualAspect(layout);
  layout.y_ticks =
      MakeTicks(layout.y_range, TickCount(layout.height, kYTickSpacing), plot.y.integers);
  layout.x_ticks =
      MakeTicks(layout.x_range, TickCount(layout.width, kXTickSpacing), plot.x.integers);
  return layout;
}

}  // namespace lift_slam
