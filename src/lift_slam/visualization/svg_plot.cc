#include "lift_slam/visualization/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "lift_slam/visualization/plot_layout.h"
#include "lift_slam/visualization/polyline.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr double kBandStripPx = 5.0;
constexpr double kRugPx = 7.0;

template <class... Args>
void Put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

int Index(PlotColor color) { return static_cast<int>(color); }

void PutGrid(const PlotLayout& l, std::string& out) {
  std::string path;
  for (const double x : l.x_ticks.values)
    Put(path, "M{:.1f} {:.1f}v{:.1f}", l.X(x), l.top, l.height);
  for (const double y : l.y_ticks.values)
    Put(path, "M{:.1f} {:.1f}h{:.1f}", l.left, l.Y(y), l.width);
  Put(out, "<path class=\"p-grid\" d=\"{}\"/>\n", path);
}

void PutAxes(const Plot& plot, const PlotLayout& l, std::string& out) {
  const double bottom = l.top + l.height;
  Put(out,
      "<rect class=\"p-frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
      l.left, l.top, l.width, l.height);
  out += "<g class=\"p-tick\" text-anchor=\"middle\">";
  for (std::size_t i = 0; i < l.x_ticks.values.size(); ++i) {
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", l.X(l.x_ticks.values[i]), bottom + 16.0,
        l.x_ticks.labels[i]);
  }
  out += "</g>\n<g class=\"p-tick\" text-anchor=\"end\">";
  for (std::size_t i = 0; i < l.y_ticks.values.size(); ++i) {
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", l.left - 7.0,
        l.Y(l.y_ticks.values[i]) + 4.0, l.y_ticks.labels[i]);
  }
  out += "</g>\n";
  Put(out, "<text class=\"p-label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
      l.left + 0.5 * l.width, bottom + 36.0, EscapeXml(plot.x.label));
  Put(out,
      "<text class=\"p-label\" text-anchor=\"middle\" transform=\"translate(13 {:.1f}) "
      "rotate(-90)\">{}</text>\n",
      l.top + 0.5 * l.height, EscapeXml(plot.y.label));
}

void PutSwatch(const LegendItem& item, std::string& out) {
  const int color = Index(item.color);
  switch (item.swatch) {
    case LegendItem::Swatch::kLine:
    case LegendItem::Swatch::kDashed:
      Put(out, "<path class=\"p-s{}{}\" stroke-width=\"2.2\" d=\"M{:.1f} {:.1f}h16\"/>", color,
          item.swatch == LegendItem::Swatch::kDashed ? " p-dash" : "", item.x, item.y);
      break;
    case LegendItem::Swatch::kPoint:
    case LegendItem::Swatch::kRing:
      Put(out, "<circle class=\"{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" stroke-width=\"1.8\"/>",
          item.swatch == LegendItem::Swatch::kRing ? "p-s" : "p-f", color, item.x + 8.0, item.y);
      break;
    case LegendItem::Swatch::kBar:
      Put(out,
          "<rect class=\"p-f{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"10\" rx=\"2\"/>",
          color, item.x + 1.0, item.y - 5.0);
      break;
    case LegendItem::Swatch::kTick:
      Put(out, "<path class=\"p-s{}\" stroke-width=\"1.4\" d=\"M{:.1f} {:.1f}v8m5 0v-8m5 0v8\"/>",
          color, item.x + 3.0, item.y - 4.0);
      break;
  }
}

void PutLegend(const PlotLayout& l, std::string& out) {
  out += "<g class=\"p-legend\">";
  for (const LegendItem& item : l.legend) {
    PutSwatch(item, out);
    Put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", item.x + 22.0, item.y + 4.0,
        EscapeXml(item.label));
  }
  out += "</g>\n";
}

void PutBands(const Plot& plot, const PlotLayout& l, std::string& out) {
  for (const PlotBand& band : plot.bands) {
    const double x = l.X(band.x_begin), width = std::max(0.8, l.X(band.x_end) - x);
    if (band.tinted) {
      Put(out,
          "<rect class=\"p-f{} p-tint\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
          "height=\"{:.1f}\"/>",
          Index(band.color), x, l.top, width, l.height);
    }
  }
}

// Above the frame, where they hide nothing.
void PutBandStrips(const Plot& plot, const PlotLayout& l, std::string& out) {
  for (const PlotBand& band : plot.bands) {
    const double x = std::max(l.left, l.X(band.x_begin));
    const double width = std::max(0.8, std::min(l.left + l.width, l.X(band.x_end)) - x);
    Put(out,
        "<rect class=\"p-f{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
        Index(band.color), x, l.top - kBandStripPx, width, kBandStripPx);
  }
}

void PutImages(const Plot& plot, const PlotLayout& l, std::string& out) {
  for (const PlotImage& image : plot.images) {
    const double x = l.X(image.x_min), y = l.Y(image.y_max);
    Put(out,
        "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
        "preserveAspectRatio=\"none\" href=\"{}\"/>\n",
        x, y, l.X(image.x_max) - x, l.Y(image.y_min) - y, image.data_uri);
  }
}

PixelLine ToPixels(const PlotSeries& series, const PlotLayout& l) {
  PixelLine line;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    line.x.push_back(l.X(series.x[i]));
    line.y.push_back(l.Y(series.y[i]));
  }
  return line;
}

void PutLine(const PlotSeries& series, const PlotLayout& l, std::string& out) {
  Put(out, "<path class=\"p-s{}\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n", Index(series.color),
      series.size_px, SvgPathData(ThinnedOut(ToPixels(series, l))));
}

void PutCircles(const PlotSeries& series, const PlotLayout& l, std::string& out) {
  const PixelLine line = ToPixels(series, l);
  Put(out, "<g class=\"{}{}\" stroke-width=\"1.8\">",
      series.kind == SeriesKind::kRings ? "p-s" : "p-f", Index(series.color));
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) continue;
    Put(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", line.x[i], line.y[i],
        0.5 * series.size_px);
  }
  out += "</g>\n";
}

void PutRug(const PlotSeries& series, const PlotLayout& l, std::string& out) {
  std::set<long> columns;  // one stroke a pixel is all that can be seen
  for (const double x : series.x) {
    if (std::isfinite(x)) columns.insert(std::lround(l.X(x)));
  }
  std::string path;
  for (const long x : columns) Put(path, "M{} {:.1f}v{:.1f}", x, l.top + l.height, -kRugPx);
  // Paler where the strokes would run together.
  const double opacity =
      std::clamp(l.width / (3.0 * static_cast<double>(columns.size() + 1)), 0.3, 1.0);
  Put(out, "<path class=\"p-s{} p-rug\" stroke-width=\"1\" stroke-opacity=\"{:.2f}\" d=\"{}\"/>\n",
      Index(series.color), opacity, path);
}

void PutBars(const PlotSeries& series, const PlotLayout& l, std::vector<double>& base,
             std::string& out) {
  base.resize(std::max(base.size(), series.y.size()), 0.0);
  const double step = series.x.size() > 1 ? (series.x.back() - series.x.front()) /
                                                static_cast<double>(series.x.size() - 1)
                                          : 1.0;
  const double pitch = std::abs(step) / l.x_range.length() * l.width;
  const double width = std::max(0.6, pitch > 4.0 ? pitch - 1.0 : pitch);
  std::string path;
  for (std::size_t i = 0; i < series.x.size() && i < series.y.size(); ++i) {
    if (!std::isfinite(series.y[i]) || series.y[i] <= 0.0) continue;
    const double bottom = l.Y(base[i]);
    base[i] += series.y[i];
    Put(path, "M{:.1f} {:.1f}h{:.1f}V{:.1f}h{:.1f}z", l.X(series.x[i]) - 0.5 * width, bottom, width,
        l.Y(base[i]), -width);
  }
  Put(out, "<path class=\"p-f{} p-bars\" d=\"{}\"/>\n", Index(series.color), path);
}

void PutSeries(const Plot& plot, const PlotLayout& l, std::string& out) {
  std::vector<double> base;
  for (const PlotSeries& series : plot.series) {
    switch (series.kind) {
      case SeriesKind::kLine:
        PutLine(series, l, out);
        break;
      case SeriesKind::kPoints:
      case SeriesKind::kRings:
        PutCircles(series, l, out);
        break;
      case SeriesKind::kRug:
        PutRug(series, l, out);
        break;
      case SeriesKind::kStackedBars:
        PutBars(series, l, base, out);
        break;
    }
  }
}

void PutLevels(const Plot& plot, const PlotLayout& l, std::string& out) {
  for (const PlotLevel& level : plot.levels) {
    Put(out, "<path class=\"p-s{} p-dash\" stroke-width=\"1.4\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n",
        Index(level.color), l.left, l.Y(level.y), l.width);
  }
}

}  // namespace

std::string RenderSvg(const Plot& plot) {
  const PlotLayout l = LayOut(plot);
  std::string out;
  Put(out,
      "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {} {}\" "
      "aria-label=\"{}\">\n",
      plot.width_px, plot.height_px, EscapeXml(plot.description));
  PutLegend(l, out);
  PutGrid(l, out);
  // A nested svg element clips what it holds to the frame.
  Put(out,
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
      "viewBox=\"{0:.1f} {1:.1f} {2:.1f} {3:.1f}\" preserveAspectRatio=\"none\">\n",
      l.left, l.top, l.width, l.height);
  PutImages(plot, l, out);
  PutBands(plot, l, out);
  PutSeries(plot, l, out);
  PutLevels(plot, l, out);
  out += "</svg>\n";
  PutBandStrips(plot, l, out);
  PutAxes(plot, l, out);
  out += "</svg>\n";
  return out;
}

std::string RenderSvgFile(const Plot& plot) {
  std::string svg = RenderSvg(plot);
  svg.insert(svg.find('\n') + 1, "<style>" + PlotStyleSheet() + "</style>\n");
  return svg;
}

std::string PlotStyleSheet() {
  std::string css = R"css(
:root{--p0:#30353c;--p1:#0072b2;--p2:#d55e00;--p3:#009e73;--p4:#e69f00;--p5:#56b4e9;--p6:#b8578f;--p7:#b3bac3;
--p-text:#3d444d;--p-grid:#e4e7eb;--p-line:#aab1ba}
@media screen and (prefers-color-scheme:dark){:root{--p0:#d5dae1;--p1:#4aa8e8;--p2:#ff8647;--p3:#35c79b;
--p4:#f3b63a;--p5:#8fd0f7;--p6:#e08fbf;--p7:#707b88;--p-text:#b4bcc6;--p-grid:#2b3139;--p-line:#545d68}}
.plot{display:block;width:100%;height:auto;font:12px system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;font-variant-numeric:tabular-nums}
.plot text{fill:var(--p-text)}.p-label{font-size:12.5px}
.p-grid{stroke:var(--p-grid);fill:none;shape-rendering:crispEdges}
.p-frame{stroke:var(--p-line);fill:none;shape-rendering:crispEdges}
.p-tint{opacity:.13}.p-dash{stroke-dasharray:6 4}.p-rug{shape-rendering:crispEdges;stroke-linecap:butt}
.plot [class^=p-s]{fill:none;stroke-linejoin:round;stroke-linecap:round}
.plot [class^="p-s"].p-rug,.plot [class^="p-s"].p-dash{stroke-linecap:butt}
)css";
  for (int i = 0; i < kNumPlotColors; ++i) {
    Put(css, ".p-s{0}{{stroke:var(--p{0})}}.p-f{0}{{fill:var(--p{0})}}\n", i);
  }
  return css;
}

}  // namespace lift_slam
