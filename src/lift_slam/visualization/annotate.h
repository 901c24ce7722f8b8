#pragma once

#include <string>

#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// The frame at most `max_width_px` wide (never enlarged) in BGR with its marks drawn: tracked
// points as green rings, unmatched features as small amber dots. Empty for an empty image.
cv::Mat DrawTrackedPoints(const AnnotatedFrame& frame, int max_width_px);

// "data:image/jpeg;base64,..." of an 8-bit image; quality 0 to 100.
std::string JpegDataUri(const cv::Mat& image, int quality = 80);
// "data:image/png;base64,..." of an 8-bit image, alpha kept.
std::string PngDataUri(const cv::Mat& image);

}  // namespace lift_slam
