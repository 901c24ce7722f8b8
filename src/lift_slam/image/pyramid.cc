#include "lift_slam/image/pyramid.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

int ScaledSize(int size, double scale) { return static_cast<int>(std::lround(size / scale)); }

// Writes into `memory` when it has the size needed.
PyramidLevel Shrink(const GrayImage& full, const GrayImage& previous, double scale,
                    cv::Mat memory) {
  const cv::Size size(ScaledSize(full.width(), scale), ScaledSize(full.height(), scale));
  cv::resize(previous.mat(), memory, size, 0.0, 0.0, cv::INTER_LINEAR);
  return {GrayImage(memory), static_cast<double>(full.width()) / size.width,
          static_cast<double>(full.height()) / size.height};
}

}  // namespace

ImagePyramid BuildPyramid(const GrayImage& image, const PyramidShape& shape) {
  ImagePyramid pyramid;
  RebuildPyramid(image, shape, pyramid);
  return pyramid;
}

void RebuildPyramid(const GrayImage& image, const PyramidShape& shape, ImagePyramid& pyramid) {
  LIFT_SLAM_CHECK(shape.scale_factor > 1.0, "scale factor is {}", shape.scale_factor);
  const int min_size = std::max(1, shape.min_size_px);
  const ImagePyramid old = std::exchange(pyramid, {});
  double scale = 1.0;
  for (int i = 0; i < shape.num_levels; ++i, scale *= shape.scale_factor) {
    if (ScaledSize(std::min(image.width(), image.height()), scale) < min_size) break;
    if (i == 0) {
      pyramid.push_back({image});
      continue;
    }
    const auto level = static_cast<std::size_t>(i);
    const cv::Mat memory = level < old.size() ? old[level].image.mat() : cv::Mat();
    pyramid.push_back(Shrink(image, pyramid.back().image, scale, memory));
  }
}

}  // namespace lift_slam
