#include "training/sift_keypoints.h"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/features/sift/sift_position.h"

namespace lift_slam::training {
namespace {

double SquareOverlap(const View& a, const View& b) {
  const double ra = kLiftHalfWidthSigmas * a.sigma, rb = kLiftHalfWidthSigmas * b.sigma;
  const auto shared = [&](double pa, double pb) {
    return std::max(0.0, std::min(pa + ra, pb + rb) - std::max(pa - ra, pb - rb));
  };
  const double common = shared(a.x, b.x) * shared(a.y, b.y);
  return common / (4.0 * ra * ra + 4.0 * rb * rb - common);
}

bool IsEmpty(const View& place, const std::vector<View>& keypoints) {
  constexpr double kMaxOverlap = 0.1;
  return std::none_of(keypoints.begin(), keypoints.end(), [&](const View& keypoint) {
    return SquareOverlap(place, keypoint) > kMaxOverlap;
  });
}

}  // namespace

std::vector<View> DetectSift(const GrayImage& image, double min_sigma, int max_count) {
  std::vector<cv::KeyPoint> found;
  cv::SIFT::create(0, 3, 0.03)->detect(image.mat(), found);
  const auto same = [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return a.pt == b.pt && a.size == b.size;
  };
  // The strongest first; equals in a fixed order.
  std::sort(found.begin(), found.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return std::tuple(-a.response, a.pt.y, a.pt.x, a.size) <
           std::tuple(-b.response, b.pt.y, b.pt.x, b.size);
  });
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  std::vector<View> keypoints;
  for (const cv::KeyPoint& keypoint : found) {
    const float sigma = 0.5F * keypoint.size;
    if (sigma < min_sigma) continue;
    if (max_count > 0 && std::ssize(keypoints) == max_count) break;
    keypoints.push_back({.x = keypoint.pt.x + kSiftPositionOffsetPx,
                         .y = keypoint.pt.y + kSiftPositionOffsetPx,
                         .sigma = sigma});
  }
  return keypoints;
}

std::vector<View> EmptyPlaces(const GrayImage& image, const std::vector<View>& keypoints, int count,
                              Random& random) {
  constexpr int kTries = 100;
  std::vector<View> places;
  if (keypoints.empty()) return places;
  for (int i = 0; i < count; ++i) {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const int scale_of = random.UniformInt(0, static_cast<int>(keypoints.size()) - 1);
      View place{.sigma = keypoints[static_cast<std::size_t>(scale_of)].sigma};
      const double half_width = kLiftHalfWidthSigmas * place.sigma;
      place.x = static_cast<float>(random.Uniform(half_width, image.width() - 1 - half_width));
      place.y = static_cast<float>(random.Uniform(half_width, image.height() - 1 - half_width));
      if (!LiesWithin(image, place.x, place.y, half_width) || !IsEmpty(place, keypoints)) continue;
      places.push_back(place);
      break;
    }
  }
  return places;
}

KeypointGrid::KeypointGrid(const std::vector<View>& keypoints, int width, int height)
    : keypoints_(keypoints), columns_(width / kCellPx + 1), rows_(height / kCellPx + 1) {
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const int column = std::clamp(static_cast<int>(keypoints[i].x) / kCellPx, 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(keypoints[i].y) / kCellPx, 0, rows_ - 1);
    cells_[static_cast<std::size_t>(row * columns_ + column)].push_back(static_cast<int>(i));
  }
}

const View* KeypointGrid::Find(double x, double y, double sigma) const {
  constexpr double kMaxSigmaRatio = 1.5;
  const double reach = std::max(1.5, 0.3 * sigma);
  const auto cell = [](double v, int count) {
    return std::clamp(static_cast<int>(v) / kCellPx, 0, count - 1);
  };
  const View* nearest = nullptr;
  double least = reach * reach;
  for (int row = cell(y - reach, rows_); row <= cell(y + reach, rows_); ++row) {
    for (int column = cell(x - reach, columns_); column <= cell(x + reach, columns_); ++column) {
      for (const int i : cells_[static_cast<std::size_t>(row * columns_ + column)]) {
        const View& keypoint = keypoints_[static_cast<std::size_t>(i)];
        const double dx = keypoint.x - x, dy = keypoint.y - y, d = dx * dx + dy * dy;
        const double ratio = std::max(keypoint.sigma / sigma, sigma / keypoint.sigma);
        if (d > least || ratio > kMaxSigmaRatio) continue;
        least = d;
        nearest = &keypoint;
      }
    }
  }
  return nearest;
}

}  // namespace lift_slam::training
