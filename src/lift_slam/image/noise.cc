#include "lift_slam/image/noise.h"

#include <opencv2/core.hpp>

namespace lift_slam {

GrayImage AddNoise(const GrayImage& image, double sigma_grey, Random& random) {
  cv::Mat pixels = image.mat().clone();
  for (int y = 0; y < pixels.rows; ++y) {
    auto* row = pixels.ptr<std::uint8_t>(y);
    for (int x = 0; x < pixels.cols; ++x) {
      row[x] = cv::saturate_cast<std::uint8_t>(row[x] + sigma_grey * random.Normal());
    }
  }
  return GrayImage(pixels);
}

}  // namespace lift_slam
