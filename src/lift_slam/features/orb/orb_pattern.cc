#include "lift_slam/features/orb/orb_pattern.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/features2d.hpp>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr int kReach = 16;      // the pattern stays within 15 pixels of the corner
constexpr int kBlurRadius = 3;  // of the smoothing before the comparison
constexpr int kProbeReach = kReach + kBlurRadius;

// The places of the dot, relative to the corner, at which one bit is set.
struct Response {
  int min_x = kProbeReach + 1, max_x = -kProbeReach - 1;
  int min_y = kProbeReach + 1, max_y = -kProbeReach - 1;
  bool IsEmpty() const { return min_x > max_x; }
};

using Responses = std::array<Response, OrbPattern::kBits>;

// A dot in the middle of an image, and upright corners all around it.
Responses Probe(int background, int dot) {
  constexpr int kMiddle = 64;
  cv::Mat image(2 * kMiddle + 1, 2 * kMiddle + 1, CV_8UC1, cv::Scalar(background));
  image.at<std::uint8_t>(kMiddle, kMiddle) = static_cast<std::uint8_t>(dot);
  std::vector<cv::KeyPoint> corners;
  for (int y = -kProbeReach; y <= kProbeReach; ++y) {
    for (int x = -kProbeReach; x <= kProbeReach; ++x) {
      corners.emplace_back(static_cast<float>(kMiddle - x), static_cast<float>(kMiddle - y),
                           /*size=*/31.0F, /*angle=*/0.0F);
    }
  }
  // An edge threshold of 0 keeps OpenCV from dropping corners, one level from scaling.
  cv::Mat rows;
  cv::ORB::create(/*nfeatures=*/1, /*scaleFactor=*/1.2F, /*nlevels=*/1, /*edgeThreshold=*/0)
      ->compute(image, corners, rows);
  LIFT_SLAM_CHECK(rows.cols * 8 == OrbPattern::kBits, "{} bytes a row", rows.cols);
  Responses responses;
  for (int row = 0; row < rows.rows; ++row) {
    const cv::Point2f& corner = corners[static_cast<std::size_t>(row)].pt;
    const int x = kMiddle - cvRound(corner.x), y = kMiddle - cvRound(corner.y);
    for (std::size_t bit = 0; bit < OrbPattern::kBits; ++bit) {
      if ((rows.at<std::uint8_t>(row, static_cast<int>(bit / 8)) >> (bit % 8) & 1) == 0) continue;
      Response& r = responses[bit];
      r = {std::min(r.min_x, x), std::max(r.max_x, x), std::min(r.min_y, y), std::max(r.max_y, y)};
    }
  }
  return responses;
}

struct Coordinates {
  float first, second;
};

// A pixel responds to the dots within kBlurRadius of it, less those nearer to the other pixel of
// its pair: the side away from the other one is whole.
Coordinates Locate(int first_min, int first_max, int second_min, int second_max) {
  if (second_max > first_max) {
    return {static_cast<float>(first_min + kBlurRadius),
            static_cast<float>(second_max - kBlurRadius)};
  }
  return {static_cast<float>(first_max - kBlurRadius),
          static_cast<float>(second_min + kBlurRadius)};
}

OrbPattern FindPattern() {
  const Responses firsts = Probe(/*background=*/255, /*dot=*/0);
  const Responses seconds = Probe(/*background=*/0, /*dot=*/255);
  OrbPattern pattern;
  for (std::size_t i = 0; i < OrbPattern::kBits; ++i) {
    const Response &first = firsts[i], &second = seconds[i];
    LIFT_SLAM_CHECK(!first.IsEmpty() && !second.IsEmpty(), "ORB bit {} responds to no dot", i);
    const Coordinates x = Locate(first.min_x, first.max_x, second.min_x, second.max_x);
    const Coordinates y = Locate(first.min_y, first.max_y, second.min_y, second.max_y);
    pattern.first_x[i] = x.first;
    pattern.first_y[i] = y.first;
    pattern.second_x[i] = x.second;
    pattern.second_y[i] = y.second;
  }
  return pattern;
}

}  // namespace

const OrbPattern& OpenCvOrbPattern() {
  static const OrbPattern pattern = FindPattern();
  return pattern;
}

}  // namespace lift_slam
