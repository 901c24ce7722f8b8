#include "lift_slam/optimization/calibration_consensus.h"

#include <Eigen/Dense>

namespace lift_slam {

CalibrationCorrection Consensus(std::span<const CalibrationCorrection> parts,
                                const SelfCalibrationOptions& options) {
  const auto count = static_cast<double>(parts.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const CalibrationCorrection& part : parts) {
    mean += Eigen::Vector2d(part.focal_scale - 1.0, part.k1) / count;
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const CalibrationCorrection& part : parts) {
    const Eigen::Vector2d off = Eigen::Vector2d(part.focal_scale - 1.0, part.k1) - mean;
    scatter += off * off.transpose();
  }
  const Eigen::Matrix2d of_mean = scatter / (count * (count - 1.0));
  const Eigen::Matrix2d prior =
      Eigen::Vector2d(options.focal_scale_sigma, options.k1_sigma).cwiseAbs2().asDiagonal();
  const Eigen::Vector2d agreed = prior * (prior + of_mean).ldlt().solve(mean);
  return {1.0 + agreed.x(), agreed.y()};
}

}  // namespace lift_slam
