#include "lift_slam/visualization/polyline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace lift_slam {
namespace {

constexpr double kMaxDeviationPx = 0.1;
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

struct Run {
  std::size_t begin, end;
};

// The stretches between gaps.
std::vector<Run> FiniteRuns(const PixelLine& line) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < line.x.size();) {
    const auto finite = [&](std::size_t k) {
      return k < line.x.size() && std::isfinite(line.x[k]) && std::isfinite(line.y[k]);
    };
    std::size_t end = i;
    while (finite(end)) ++end;
    if (end > i) runs.push_back({i, end});
    i = end + 1;
  }
  return runs;
}

void Append(const PixelLine& from, std::size_t i, PixelLine& to) {
  to.x.push_back(from.x[i]);
  to.y.push_back(from.y[i]);
}

void ThinByColumn(const PixelLine& line, const Run& run, PixelLine& out) {
  for (std::size_t i = run.begin; i < run.end;) {
    std::size_t end = i;
    std::size_t low = i, high = i;
    for (; end < run.end && std::floor(line.x[end]) == std::floor(line.x[i]); ++end) {
      if (line.y[end] < line.y[low]) low = end;
      if (line.y[end] > line.y[high]) high = end;
    }
    std::array<std::size_t, 4> keep = {i, std::min(low, high), std::max(low, high), end - 1};
    const auto last = std::unique(keep.begin(), keep.end());
    std::for_each(keep.begin(), last, [&](std::size_t k) { Append(line, k, out); });
    i = end;
  }
}

void ThinByDistance(const PixelLine& line, const Run& run, double tolerance_px, PixelLine& out) {
  Append(line, run.begin, out);
  for (std::size_t i = run.begin + 1; i < run.end; ++i) {
    const double distance = std::hypot(line.x[i] - out.x.back(), line.y[i] - out.y.back());
    if (distance >= tolerance_px || i + 1 == run.end) Append(line, i, out);
  }
}

// Of a stretch, only what is needed to stay within kMaxDeviationPx of all its points.
void Straighten(const PixelLine& stretch, PixelLine& out) {
  std::vector<cv::Point2f> points(stretch.x.size()), corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {static_cast<float>(stretch.x[i]), static_cast<float>(stretch.y[i])};
  }
  constexpr bool kClosed = false;
  cv::approxPolyDP(points, corners, kMaxDeviationPx, kClosed);
  // Corners are some of the points, in order: those are taken, unrounded.
  for (std::size_t i = 0, next = 0; i < points.size() && next < corners.size(); ++i) {
    if (points[i] != corners[next]) continue;
    Append(stretch, i, out);
    ++next;
  }
}

}  // namespace

PixelLine ThinnedOut(const PixelLine& line, double tolerance_px) {
  PixelLine out;
  for (const Run& run : FiniteRuns(line)) {
    if (!out.x.empty()) {
      out.x.push_back(kGap);
      out.y.push_back(kGap);
    }
    const auto begin = line.x.begin() + static_cast<std::ptrdiff_t>(run.begin);
    const auto end = line.x.begin() + static_cast<std::ptrdiff_t>(run.end);
    PixelLine stretch;
    if (std::is_sorted(begin, end)) {
      ThinByColumn(line, run, stretch);
    } else {
      ThinByDistance(line, run, tolerance_px, stretch);
    }
    Straighten(stretch, out);
  }
  return out;
}

std::string SvgPathData(const PixelLine& line) {
  std::string path;
  const auto out = std::back_inserter(path);
  for (const Run& run : FiniteRuns(line)) {
    fmt::format_to(out, "M{:.1f} {:.1f}", line.x[run.begin], line.y[run.begin]);
    if (run.end == run.begin + 1) path += "h0";
    for (std::size_t i = run.begin + 1; i < run.end; ++i) {
      fmt::format_to(out, "L{:.1f} {:.1f}", line.x[i], line.y[i]);
    }
  }
  return path;
}

}  // namespace lift_slam
