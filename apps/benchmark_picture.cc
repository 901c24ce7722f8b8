#include "apps/benchmark_picture.h"

#include <cctype>

#include "lift_slam/visualization/dot_chart.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {
namespace {

std::string FileName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (is_plain) name += c;
    if (!is_plain && !name.empty() && name.back() != '_') name += '_';
  }
  return name;
}

}  // namespace

BenchmarkPicture MakePicture(std::string section, const std::string& name, std::string title,
                             std::string note, const Plot& plot) {
  return {std::move(section), FileName(name) + ".svg", std::move(title),
          std::move(note),    RenderSvg(plot),         RenderSvgFile(plot)};
}

BenchmarkPicture MakePicture(std::string section, const std::string& name, std::string title,
                             std::string note, const DotChart& chart) {
  return {std::move(section), FileName(name) + ".svg", std::move(title),
          std::move(note),    RenderSvg(chart),        RenderSvgFile(chart)};
}

}  // namespace lift_slam
