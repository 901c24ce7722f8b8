#include "lift_slam/features/orb/orb_descriptor.h"

#include <numbers>
#include <opencv2/features2d.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {

struct OrbDescriptor::Impl {
  // One level, and an edge threshold of 0: OpenCV then neither scales the image nor drops
  // keypoints, so row i stays keypoint i.
  cv::Ptr<cv::ORB> orb = cv::ORB::create(/*nfeatures=*/1, /*scaleFactor=*/1.2F, /*nlevels=*/1,
                                         /*edgeThreshold=*/0);
};

OrbDescriptor::OrbDescriptor() : impl_(std::make_unique<Impl>()) {}
OrbDescriptor::~OrbDescriptor() = default;
OrbDescriptor::OrbDescriptor(OrbDescriptor&&) noexcept = default;

void OrbDescriptor::Describe(const GrayImage& level, std::span<const OrientedCorner> corners,
                             std::byte* rows) const {
  if (corners.empty()) return;
  std::vector<cv::KeyPoint> keypoints;
  keypoints.reserve(corners.size());
  for (const OrientedCorner& corner : corners) {
    const float degrees = corner.angle_rad * (180.0F / std::numbers::pi_v<float>);
    keypoints.emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y),
                           /*size=*/31.0F, degrees);
    keypoints.back().octave = 0;
  }
  const auto count = static_cast<int>(corners.size());
  cv::Mat out(count, static_cast<int>(kBytes), CV_8U, rows);
  impl_->orb->compute(level.mat(), keypoints, out);
  LIFT_SLAM_CHECK(out.rows == count && out.data == reinterpret_cast<uchar*>(rows),
                  "{} descriptors for {} corners", out.rows, count);
}

}  // namespace lift_slam
