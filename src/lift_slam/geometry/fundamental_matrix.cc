#include "lift_slam/geometry/fundamental_matrix.h"

#include <opencv2/calib3d.hpp>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

std::vector<cv::Point2d> AsPoints(std::span<const Eigen::Vector2d> positions) {
  std::vector<cv::Point2d> points;
  points.reserve(positions.size());
  for (const Eigen::Vector2d& p : positions) points.emplace_back(p.x(), p.y());
  return points;
}

cv::UsacParams Parameters(double max_error_px) {
  cv::UsacParams parameters;
  parameters.threshold = max_error_px;
  parameters.confidence = 0.9999;
  parameters.maxIterations = 10000;
  parameters.randomGeneratorState = 0;
  parameters.isParallel = false;
  parameters.loMethod = cv::LOCAL_OPTIM_INNER_LO;
  parameters.score = cv::SCORE_METHOD_MSAC;
  return parameters;
}

}  // namespace

std::optional<Eigen::Matrix3d> FindFundamentalMatrix(std::span<const Eigen::Vector2d> in_image1,
                                                     std::span<const Eigen::Vector2d> in_image2,
                                                     double max_error_px) {
  LIFT_SLAM_CHECK(in_image1.size() == in_image2.size(), "{} points matched with {}",
                  in_image1.size(), in_image2.size());
  constexpr std::size_t kMinMatches = 8;
  if (in_image1.size() < kMinMatches) return std::nullopt;
  std::vector<unsigned char> mask;
  const cv::Mat found = cv::findFundamentalMat(AsPoints(in_image1), AsPoints(in_image2), mask,
                                               Parameters(max_error_px));
  if (found.rows != 3 || found.cols != 3) return std::nullopt;
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix(row, column) = found.at<double>(row, column);
  }
  if (!matrix.allFinite() || matrix.norm() == 0.0) return std::nullopt;
  return matrix / matrix.norm();
}

}  // namespace lift_slam
