#pragma once

#include <Eigen/Core>

#include "lift_slam/image/image.h"

namespace lift_slam {

// The image of the same size whose pixel h(x) shows what the image shows at x, for the homography
// h = warped_from_image (pixels, (0, 0) the centre of the top-left one). Bilinear; mirrored at the
// border. CheckError for an empty image.
GrayImage WarpImage(const GrayImage& image, const Eigen::Matrix3d& warped_from_image);

}  // namespace lift_slam
