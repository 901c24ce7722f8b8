#include "lift_slam/image/pyramid.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

int ScaledSize(int size, double scale) { return static_cast<int>(std::lround(size / scale)); }

PyramidLevel Shrink(const GrayImage& full, const GrayImage& previous, double scale) {
  const cv::Size size(ScaledSize(full.width(), scale), ScaledSize(full.height(), scale));
  cv::Mat image;
  cv::resize(previous.mat(), image, size, 0.0, 0.0, cv::INTER_LINEAR);
  return {GrayImage(image), static_cast<double>(full.width()) / size.width,
          static_cast<double>(full.height()) / size.height};
}

}  // namespace

ImagePyramid BuildPyramid(const GrayImage& image, const PyramidShape& shape) {
  LIFT_SLAM_CHECK(shape.scale_factor > 1.0, "scale factor is {}", shape.scale_factor);
  const int min_size = std::max(1, shape.min_size_px);
  ImagePyramid pyramid;
  double scale = 1.0;
  for (int level = 0; level < shape.num_levels; ++level, scale *= shape.scale_factor) {
    if (ScaledSize(std::min(image.width(), image.height()), scale) < min_size) break;
    pyramid.push_back(level == 0 ? PyramidLevel{image}
                                 : Shrink(image, pyramid.back().image, scale));
  }
  return pyramid;
}

}  // namespace lift_slam
