#include "lift_slam/visualization/keypoint_picture.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// OpenCV takes coordinates as integers with this many fractional bits.
constexpr int kShift = 4;

cv::Point Fixed(double x, double y) {
  return {cvRound(x * (1 << kShift)), cvRound(y * (1 << kShift))};
}

}  // namespace

std::string KeypointPicture(const GrayImage& image, const FeatureSet& features,
                            const ScaleLevels& levels) {
  const cv::Scalar colour(140, 235, 20);  // BGR
  cv::Mat picture;
  cv::cvtColor(image.mat(), picture, cv::COLOR_GRAY2BGR);
  for (const Keypoint& k : features.keypoints) {
    const double radius = 2.0 * levels.Scale(k.level);
    const double end_x = k.x + radius * std::cos(k.angle_rad);
    const double end_y = k.y + radius * std::sin(k.angle_rad);
    cv::circle(picture, Fixed(k.x, k.y), cvRound(radius * (1 << kShift)), colour, 1, cv::LINE_AA,
               kShift);
    cv::line(picture, Fixed(k.x, k.y), Fixed(end_x, end_y), colour, 1, cv::LINE_AA, kShift);
  }
  std::vector<unsigned char> bytes;
  LIFT_SLAM_CHECK(cv::imencode(".png", picture, bytes), "cannot encode a {} x {} picture",
                  picture.cols, picture.rows);
  return {bytes.begin(), bytes.end()};
}

}  // namespace lift_slam
