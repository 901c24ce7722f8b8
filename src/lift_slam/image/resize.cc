#include "lift_slam/image/resize.h"

#include <opencv2/imgproc.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {

GrayImage Resize(const GrayImage& image, int width, int height) {
  GrayImage resized;
  ResizeInto(image, width, height, resized);
  return resized;
}

void ResizeInto(const GrayImage& image, int width, int height, GrayImage& memory) {
  LIFT_SLAM_CHECK(width > 0 && height > 0 && !image.empty(), "resizing {} x {} to {} x {}",
                  image.width(), image.height(), width, height);
  const bool is_shared = memory.mat().u == nullptr || memory.mat().u->refcount > 1;
  cv::Mat pixels = is_shared ? cv::Mat() : memory.mat();
  cv::resize(image.mat(), pixels, {width, height}, 0.0, 0.0, cv::INTER_LINEAR);
  memory = GrayImage(pixels);
}

}  // namespace lift_slam
