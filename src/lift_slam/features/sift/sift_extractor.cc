#include "lift_slam/features/sift/sift_extractor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>

#include "lift_slam/features/sift/sift_position.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
namespace {

constexpr int kLevelsPerOctave = 12;
constexpr int kNumLevels = 10 * kLevelsPerOctave;

Keypoint FromOpenCv(const cv::KeyPoint& found) {
  const double sigma = std::max(1.0, 0.5 * static_cast<double>(found.size));
  const double angle_deg = found.angle > 180.0F ? found.angle - 360.0F : found.angle;
  const auto level = static_cast<int>(std::lround(kLevelsPerOctave * std::log2(sigma)));
  return {.x = found.pt.x + kSiftPositionOffsetPx,
          .y = found.pt.y + kSiftPositionOffsetPx,
          .angle_rad = static_cast<float>(angle_deg * std::numbers::pi / 180.0),
          .response = found.response,
          .level = std::min(level, kNumLevels - 1)};
}

}  // namespace

SiftExtractor::SiftExtractor(const SiftOptions& options)
    : options_(options), scale_levels_{kNumLevels, std::exp2(1.0 / kLevelsPerOctave), 0.5} {
  CheckOptionRange("sift.max_features", options.max_features, 0, 100000);
  CheckOptionRange("sift.contrast_threshold", options.contrast_threshold, 1e-6, 1.0);
}

FeatureSet SiftExtractor::Extract(const GrayImage& image) {
  std::vector<cv::KeyPoint> found;
  cv::Mat values;
  if (!image.empty()) {
    cv::SIFT::create(options_.max_features, 3, options_.contrast_threshold)
        ->detectAndCompute(image.mat(), cv::noArray(), found, values);
  }
  FeatureSet features{{}, Descriptors(kind_, found.size())};
  for (std::size_t i = 0; i < found.size(); ++i) {
    features.keypoints.push_back(FromOpenCv(found[i]));
    std::memcpy(features.descriptors.mutable_row(i).data(), values.ptr<float>(static_cast<int>(i)),
                kind_.BytesPerRow());
  }
  return features;
}

}  // namespace lift_slam
