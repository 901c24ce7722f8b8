#include "lift_slam/image/gamma.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {

GrayImage ApplyGamma(const GrayImage& image, double gamma) {
  LIFT_SLAM_CHECK(gamma > 0.0, "gamma is {}", gamma);
  if (image.empty()) return image;
  cv::Mat table(1, 256, CV_8UC1), result;
  for (int v = 0; v < 256; ++v) {
    table.at<std::uint8_t>(v) =
        static_cast<std::uint8_t>(std::lround(255.0 * std::pow(v / 255.0, gamma)));
  }
  cv::LUT(image.mat(), table, result);
  return GrayImage(result);
}

}  // namespace lift_slam
