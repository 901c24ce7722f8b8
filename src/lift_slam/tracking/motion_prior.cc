#include "lift_slam/tracking/motion_prior.h"

#include <algorithm>

namespace lift_slam {
namespace {

constexpr double kSmoothing = 0.02;  // weight of a frame in what is usual
constexpr double kMaxRise = 3.0;     // a frame's change counts up to this multiple of the usual one
// Standard deviation along an axis over the usual distance, which has three axes (1.6 sigma on
// average) and the noise of the three places that it comes from. Measured: docs/accuracy.md.
constexpr double kSigmaOfChange = 0.4;
// Below this share of the usual way the camera stands; it may start again as it usually changes.
constexpr double kStandingRatio = 0.1;

}  // namespace

void MotionPrior::Expect(const Rigid3d& last_cam_from_world, const Rigid3d& cam_from_world) {
  const Eigen::Vector3d center = cam_from_world.TargetOriginInSource();
  expected_ = {center, (center - last_cam_from_world.TargetOriginInSource()).norm()};
  if (usual_way_ == 0.0) usual_way_ = expected_->way;
}

CenterPrior MotionPrior::For(int num_matches) const {
  if (!expected_ || num_matches >= options_.min_matches) return {};
  const double sigma = std::max(kSigmaOfChange * change_ratio_, options_.min_change_ratio) *
                       std::max(expected_->way, usual_way_);
  if (!(sigma > 0.0)) return {};
  return {expected_->center, 1.0 / (sigma * sigma)};
}

void MotionPrior::Learn(const Rigid3d& cam_from_world) {
  if (!expected_ || !(usual_way_ > 0.0)) return;
  if (!(expected_->way > kStandingRatio * usual_way_)) return;
  const double distance = (cam_from_world.TargetOriginInSource() - expected_->center).norm();
  const double most = kMaxRise * std::max(change_ratio_, options_.min_change_ratio);
  change_ratio_ += kSmoothing * (std::min(distance / usual_way_, most) - change_ratio_);
  usual_way_ += kSmoothing * (expected_->way - usual_way_);
}

void MotionPrior::Rescale(double scale) {
  expected_.reset();
  usual_way_ *= scale;
}

}  // namespace lift_slam
