#include "lift_slam/visualization/dot_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lift_slam/visualization/plot_layout.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr double kMarginPx = 10.0, kDotRadiusPx = 4.0, kCrossPx = 3.5;
constexpr double kWidestFont = 1.1;       // DejaVu Sans, over the estimated width
constexpr double kFailedColumnPx = 76.0;  // right of the frame
constexpr double kLegendRowPx = 20.0, kAxisPx = 46.0, kTickSpacingPx = 72.0;
constexpr double kRowPx = 16.0, kLanePx = 9.0;  // of a category, and more for each system

template <class... Args>
void Put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

struct Layout {
  double left = 0.0, top = 0.0, width = 0.0, row = 0.0;
  int height_px = 0;
  AxisRange range;
  AxisTicks ticks;

  double X(double value) const { return left + (value - range.min) / range.length() * width; }
  // Systems of a category stand under one another, so that none hides another.
  double Y(std::size_t category, std::size_t lane) const {
    return top + row * static_cast<double>(category) + 0.5 * kRowPx +
           kLanePx * (static_cast<double>(lane) + 0.5);
  }
};

bool HasFailure(const DotChart& chart) {
  return std::ranges::any_of(chart.series, [](const DotSeries& series) {
    return std::ranges::find(series.values, DotSeries::kFailed) != series.values.end();
  });
}

int LegendRows(const DotChart& chart, double left) {
  double x = left;
  int rows = 1;
  for (const DotSeries& series : chart.series) {
    const double width = 40.0 + TextWidth(series.label);
    if (x > left && x + width > chart.width_px) {
      x = left;
      ++rows;
    }
    x += width;
  }
  return rows;
}

Layout LayOutChart(const DotChart& chart) {
  Layout l;
  for (const std::string& category : chart.categories) {
    l.left = std::max(l.left, kWidestFont * TextWidth(category) + 2.0 * kMarginPx);
  }
  l.top = 6.0 + kLegendRowPx * LegendRows(chart, l.left);
  l.width = chart.width_px - l.left - (HasFailure(chart) ? kFailedColumnPx : 2.0 * kMarginPx);
  l.row = kRowPx + kLanePx * static_cast<double>(std::max<std::size_t>(chart.series.size(), 1));
  const double height = l.row * static_cast<double>(chart.categories.size());
  l.height_px = static_cast<int>(l.top + height + kAxisPx);
  AxisRange range;
  range.Add(chart.axis.min.value_or(0.0));
  for (const DotSeries& series : chart.series) {
    range.Add(series.values);
    range.Add(series.low);
    range.Add(series.high);
  }
  const int max_ticks = std::max(2, static_cast<int>(l.width / kTickSpacingPx));
  l.range = GrownToTicks(range, max_ticks);
  l.ticks = MakeTicks(l.range, max_ticks, chart.axis.integers);
  return l;
}

void PutLegend(const DotChart& chart, const Layout& l, std::string& out) {
  double x = l.left, y = 10.0;
  out += "<g class=\"p-legend\">";
  for (const DotSeries& series : chart.series) {
    const double width = 40.0 + TextWidth(series.label);
    if (x > l.left && x + width > chart.width_px) {
      x = l.left;
      y += kLegendRowPx;
    }
    Put(out, "<circle class=\"p-f{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>",
        static_cast<int>(series.color), x + 8.0, y);
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 18.0, y + 4.0,
        EscapeXml(series.label));
    x += width;
  }
  out += "</g>\n";
}

void PutFrame(const DotChart& chart, const Layout& l, std::string& out) {
  const double height = l.row * static_cast<double>(chart.categories.size());
  std::string grid;
  for (const double x : l.ticks.values) Put(grid, "M{:.1f} {:.1f}v{:.1f}", l.X(x), l.top, height);
  for (std::size_t i = 1; i < chart.categories.size(); ++i) {
    Put(grid, "M{:.1f} {:.1f}h{:.1f}", l.left, l.top + l.row * static_cast<double>(i), l.width);
  }
  Put(out, "<path class=\"p-grid\" d=\"{}\"/>\n", grid);
  Put(out,
      "<rect class=\"p-frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
      l.left, l.top, l.width, height);
  out += "<g class=\"p-tick\" text-anchor=\"middle\">";
  for (std::size_t i = 0; i < l.ticks.values.size(); ++i) {
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", l.X(l.ticks.values[i]),
        l.top + height + 16.0, l.ticks.labels[i]);
  }
  out += "</g>\n<g class=\"p-tick\" text-anchor=\"end\">";
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", l.left - kMarginPx,
        l.top + l.row * (static_cast<double>(i) + 0.5) + 4.0, EscapeXml(chart.categories[i]));
  }
  out += "</g>\n";
  Put(out, "<text class=\"p-label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
      l.left + 0.5 * l.width, l.top + height + 36.0, EscapeXml(chart.axis.label));
  if (!HasFailure(chart)) return;
  Put(out,
      "<text class=\"p-label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">failed</text>\n",
      l.left + l.width + 0.5 * kFailedColumnPx, l.top + height + 16.0);
}

void PutBar(const DotSeries& series, std::size_t category, double y, const Layout& l,
            std::string& out) {
  if (category >= std::min(series.low.size(), series.high.size())) return;
  const double low = series.low[category], high = series.high[category];
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  Put(out, "<path class=\"p-s{}\" stroke-width=\"2\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n",
      static_cast<int>(series.color), l.X(low), y, l.X(high));
}

void PutSeries(const DotSeries& series, std::size_t lane, std::size_t num_categories,
               const Layout& l, std::string& out) {
  const int color = static_cast<int>(series.color);
  for (std::size_t i = 0; i < std::min(series.values.size(), num_categories); ++i) {
    const double value = series.values[i], y = l.Y(i, lane);
    if (value == DotSeries::kFailed) {
      const double x = l.left + l.width + 0.5 * kFailedColumnPx - kCrossPx;
      Put(out,
          "<path class=\"p-s{0}\" stroke-width=\"2\" d=\"M{1:.1f} {2:.1f}l{4:.1f} {4:.1f}M{1:.1f} "
          "{3:.1f}l{4:.1f} {5:.1f}\"/>\n",
          color, x, y - kCrossPx, y + kCrossPx, 2.0 * kCrossPx, -2.0 * kCrossPx);
    } else if (std::isfinite(value)) {
      // A thin line from the axis leads the eye from the dot to its system's lane.
      Put(out,
          "<path class=\"p-s{}\" stroke-width=\"1\" stroke-opacity=\"0.35\" d=\"M{:.1f} "
          "{:.1f}H{:.1f}\"/><circle class=\"p-f{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n",
          color, l.left, y, l.X(value), color, l.X(value), y, kDotRadiusPx);
      PutBar(series, i, y, l, out);
    }
  }
}

}  // namespace

std::string RenderSvg(const DotChart& chart) {
  const Layout l = LayOutChart(chart);
  std::string out;
  Put(out,
      "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {} {}\" "
      "aria-label=\"{}\">\n",
      chart.width_px, l.height_px, EscapeXml(chart.description));
  PutLegend(chart, l, out);
  PutFrame(chart, l, out);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    PutSeries(chart.series[i], i, chart.categories.size(), l, out);
  }
  return out + "</svg>\n";
}

std::string RenderSvgFile(const DotChart& chart) {
  std::string svg = RenderSvg(chart);
  svg.insert(svg.find('\n') + 1, "<style>" + PlotStyleSheet() + "</style>\n");
  return svg;
}

}  // namespace lift_slam
