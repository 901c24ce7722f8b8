#include "lift_slam/image/warp.h"

#include <opencv2/imgproc.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {

GrayImage WarpImage(const GrayImage& image, const Eigen::Matrix3d& warped_from_image) {
  LIFT_SLAM_CHECK(!image.empty(), "warping an empty image");
  cv::Matx33d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix(row, column) = warped_from_image(row, column);
  }
  cv::Mat warped;
  cv::warpPerspective(image.mat(), warped, matrix, image.mat().size(), cv::INTER_LINEAR,
                      cv::BORDER_REFLECT_101);
  return GrayImage(warped);
}

}  // namespace lift_slam
