#include "lift_slam/visualization/map_raster.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/visualization/annotate.h"
#include "lift_slam/visualization/axis.h"

namespace lift_slam {
namespace {

// From the lowest to the highest value that matters: [share, 1 - share] of the sorted values.
std::pair<double, double> MiddlePart(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = [&](double f) { return values[static_cast<std::size_t>(std::lround(f * last))]; };
  return {at(share), at(1.0 - share)};
}

struct Interval {
  double min, max;
};

Interval IntervalOf(const std::vector<double>& points, const std::vector<double>& path,
                    double path_size) {
  AxisRange range;
  range.Add(path);
  if (range.empty) range = {0.0, 0.0, false};
  if (!points.empty()) {
    const auto [low, high] = MiddlePart(points, 0.02);
    const double reach = 4.0 * path_size;  // a wild point must not shrink all the rest
    const Interval limit = {range.min - reach, range.max + reach};
    range.Add(path_size > 0.0 ? std::max(low, limit.min) : low);
    range.Add(path_size > 0.0 ? std::min(high, limit.max) : high);
  }
  range = WithLength(range);
  const double margin = 0.04 * range.length();
  return {range.min - margin, range.max + margin};
}

// About its middle, to at least this length.
void Grow(double length, Interval& interval) {
  const double add = 0.5 * std::max(0.0, length - (interval.max - interval.min));
  interval = {interval.min - add, interval.max + add};
}

double SizeOf(const ScenePath& path) {
  AxisRange right, up;
  right.Add(path.right);
  up.Add(path.up);
  return std::hypot(right.length(), up.length());
}

// Mid greys, so that black and white pixels show on any background.
std::uint8_t VisibleGray(std::uint8_t gray) {
  return static_cast<std::uint8_t>(70 + gray * 105 / 255);
}

}  // namespace

MapExtent ExtentOf(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                   double aspect) {
  std::vector<double> right, up;
  for (const PointRecord& point : run.points) {
    if (!scene.Shows(path, point.map_index)) continue;
    const Eigen::Vector3d x = scene.OnPage(point.position);
    if (!x.allFinite()) continue;
    right.push_back(x.x());
    up.push_back(x.y());
  }
  const double size = SizeOf(path);
  Interval r = IntervalOf(right, path.right, size), u = IntervalOf(up, path.up, size);
  Grow(aspect * (u.max - u.min), r);
  Grow((r.max - r.min) / aspect, u);
  return {r.min, r.max, u.min, u.max};
}

PlotImage RasterOfPoints(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                         const MapExtent& e, int long_side_px) {
  const double width = e.right_max - e.right_min, height = e.up_max - e.up_min;
  const double px_per_unit = long_side_px / std::max(width, height);
  const cv::Size size(std::max(2, cvCeil(width * px_per_unit)),
                      std::max(2, cvCeil(height * px_per_unit)));
  const int dot_px = run.points.size() > 15'000 ? 2 : 3;
  cv::Mat image(size, CV_8UC4, cv::Scalar::all(0));
  for (const PointRecord& point : run.points) {
    if (!scene.Shows(path, point.map_index)) continue;
    const Eigen::Vector3d x = scene.OnPage(point.position);
    const double column = (x.x() - e.right_min) / width * size.width;
    const double row = (e.up_max - x.y()) / height * size.height;
    if (!(column >= 0.0 && column < size.width - 1 && row >= 0.0 && row < size.height - 1))
      continue;
    // Few points are drawn larger.
    const std::uint8_t gray = VisibleGray(point.gray);
    const cv::Rect dot(static_cast<int>(column), static_cast<int>(row), dot_px, dot_px);
    image(dot & cv::Rect({0, 0}, size)) = cv::Scalar(gray, gray, gray, 215);
  }
  return {PngDataUri(image), e.right_min, e.right_max, e.up_min, e.up_max};
}

}  // namespace lift_slam
