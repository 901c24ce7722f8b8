#include "lift_slam/datasets/ground_truth.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/geometry/timestamp_text.h"

namespace lift_slam {

std::optional<std::string> DescribeMissingOverlap(const Trajectory& truth,
                                                  std::int64_t first_frame_ns,
                                                  std::int64_t last_frame_ns) {
  const std::int64_t begin = truth.front().timestamp_ns, end = truth.back().timestamp_ns;
  if (begin <= last_frame_ns && end >= first_frame_ns) return std::nullopt;
  std::string text =
      fmt::format("the poses cover {} s to {} s and the images {} s to {} s", FormatSeconds(begin),
                  FormatSeconds(end), FormatSeconds(first_frame_ns), FormatSeconds(last_frame_ns));
  const double ratio = (std::abs(static_cast<double>(end)) + 1.0) /
                       (std::abs(static_cast<double>(last_frame_ns)) + 1.0);
  if (ratio > 1e6 || ratio < 1e-6) text += "; are seconds and nanoseconds mixed up?";
  return text;
}

}  // namespace lift_slam
