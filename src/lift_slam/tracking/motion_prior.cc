#include "lift_slam/tracking/motion_prior.h"

#include <algorithm>

#include "lift_slam/util/option_range.h"

namespace lift_slam {
namespace {

constexpr int kMinLearned = 20;      // frames before anything is expected
constexpr double kSmoothing = 0.02;  // weight of a frame in what is usual, once this is known
constexpr double kMaxRise = 3.0;     // a frame's change counts up to this multiple of the usual one
// Standard deviation along an axis over the usual distance, which has three axes (1.6 sigma on
// average) and the noise of the three places that it comes from. Measured: docs/scale.md.
constexpr double kSigmaOfChange = 0.4;
// Below this share of the usual way the camera stands; it may start again as it usually changes.
constexpr double kStandingRatio = 0.1;

}  // namespace

void MotionPriorOptions::Check() const {
  CheckOptionRange("motion_prior.min_match_share", min_match_share, 0.0, 1.0);
  CheckOptionRange("motion_prior.min_change_ratio", min_change_ratio, 1e-4, 10.0);
}

void MotionPrior::Expect(const Rigid3d& last_cam_from_world, const Rigid3d& cam_from_world) {
  const Eigen::Vector3d center = cam_from_world.TargetOriginInSource();
  expected_ = {center, (center - last_cam_from_world.TargetOriginInSource()).norm()};
}

double MotionPrior::Way() const { return std::max(expected_->way, usual_way_); }

CenterPrior MotionPrior::For(int num_matches, int num_features) const {
  const bool is_enough = num_matches >= options_.min_match_share * num_features;
  if (!expected_ || is_enough || num_learned_ < kMinLearned) return {};
  const double sigma = std::max(kSigmaOfChange * change_ratio_, options_.min_change_ratio) * Way();
  if (!(sigma > 0.0)) return {};
  return {expected_->center, 1.0 / (sigma * sigma)};
}

void MotionPrior::Learn(const Rigid3d& cam_from_world) {
  if (!expected_ || !(expected_->way > kStandingRatio * usual_way_)) return;
  double change = (cam_from_world.TargetOriginInSource() - expected_->center).norm() / Way();
  if (num_learned_ >= kMinLearned) {
    change = std::min(change, kMaxRise * std::max(change_ratio_, options_.min_change_ratio));
  }
  ++num_learned_;
  const double weight = std::max(kSmoothing, 1.0 / num_learned_);
  change_ratio_ += weight * (change - change_ratio_);
  usual_way_ += weight * (expected_->way - usual_way_);
}

void MotionPrior::Rescale(double scale) {
  expected_.reset();
  usual_way_ *= scale;
}

}  // namespace lift_slam
