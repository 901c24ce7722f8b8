#pragma once

#include <opencv2/core.hpp>

#include "lift_slam/util/random.h"

namespace lift_slam {

// Every pixel drawn on its own, 0 to 255.
inline cv::Mat NoiseImage(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.at<uchar>(y, x) = static_cast<uchar>(random.UniformInt(0, 255));
  }
  return image;
}

}  // namespace lift_slam
