#include "lift_slam/visualization/axis.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

double NiceStep(double length, int max_count) {
  const double raw = length / std::max(1, max_count - 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::string TickLabel(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  const double magnitude = std::abs(value);
  std::string text;
  if (magnitude >= 1e6 || step < 1e-4) {
    text = fmt::format("{:.4g}", value);
  } else {
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    text = fmt::format("{:.{}f}", value, decimals);
  }
  return text[0] == '-' ? "\xE2\x88\x92" + text.substr(1) : text;
}

}  // namespace

void AxisRange::Add(double value) {
  if (!std::isfinite(value)) return;
  min = empty ? value : std::min(min, value);
  max = empty ? value : std::max(max, value);
  empty = false;
}

void AxisRange::Add(const std::vector<double>& values) {
  for (const double value : values) Add(value);
}

AxisTicks MakeTicks(const AxisRange& range, int max_count, bool integers) {
  LIFT_SLAM_CHECK(range.length() > 0.0, "range {} .. {}", range.min, range.max);
  AxisTicks ticks;
  ticks.step = NiceStep(range.length(), max_count);
  if (integers) ticks.step = std::max(1.0, ticks.step);
  const double tolerance = 1e-6;
  const double first = std::ceil(range.min / ticks.step - tolerance);
  const double last = std::floor(range.max / ticks.step + tolerance);
  for (double i = first; i <= last; i += 1.0) {
    ticks.values.push_back(i * ticks.step);
    ticks.labels.push_back(TickLabel(i * ticks.step, ticks.step));
  }
  return ticks;
}

AxisRange WithLength(const AxisRange& range) {
  if (range.empty) return {0.0, 1.0, false};
  const double scale = std::max(std::abs(range.min), std::abs(range.max));
  if (range.length() > 1e-9 * scale && range.length() > 0.0) return range;
  const double half = scale > 0.0 ? 0.5 * scale : 0.5;
  return {range.min - half, range.max + half, false};
}

AxisRange GrownToTicks(const AxisRange& range, int max_count) {
  const AxisRange grown = WithLength(range);
  const double step = NiceStep(grown.length(), max_count);
  return {std::floor(grown.min / step + 1e-6) * step, std::ceil(grown.max / step - 1e-6) * step,
          false};
}

}  // namespace lift_slam
