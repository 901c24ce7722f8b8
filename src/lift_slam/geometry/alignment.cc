#include "lift_slam/geometry/alignment.h"

#include <Eigen/SVD>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kMinSingularValueRatio = 1e-12;
constexpr std::size_t kMinPositions = 3;
// Positions that differ by less than this part of their distance from the origin are equal but for
// rounding.
constexpr double kMinExtentRatio = 1e-12;

Alignment Failure(AlignmentFailure failure) { return {std::nullopt, failure}; }

Eigen::Vector3d Mean(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

bool HasExtent(double variance, const Eigen::Vector3d& mean) {
  return std::sqrt(variance) > kMinExtentRatio * mean.norm();
}

std::vector<Eigen::Vector3d> Positions(std::span<const Rigid3d> world_from_cam) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(world_from_cam.size());
  for (const Rigid3d& pose : world_from_cam) positions.push_back(pose.translation);
  return positions;
}

// The rigid motion that lays the first estimated pose on the first reference pose.
Rigid3d OriginAlignment(std::span<const Rigid3d> estimate, std::span<const Rigid3d> reference) {
  return reference.front() * Inverse(estimate.front());
}

// x and y: positions relative to the first pose, each in the frame of that pose.
Alignment AlignScale(std::span<const Rigid3d> estimate, std::span<const Rigid3d> reference) {
  const Rigid3d first_from_estimate = Inverse(estimate.front());
  const Rigid3d first_from_reference = Inverse(reference.front());
  double sum_xy = 0.0;
  double sum_xx = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Eigen::Vector3d x = first_from_estimate * estimate[i].translation;
    const Eigen::Vector3d y = first_from_reference * reference[i].translation;
    sum_xy += x.dot(y);
    sum_xx += x.squaredNorm();
  }
  if (sum_xx == 0.0) return Failure(AlignmentFailure::kNoExtent);
  const double scale = sum_xy / sum_xx;
  if (!(scale > 0.0)) return Failure(AlignmentFailure::kScaleNotPositive);
  const Sim3d scaled(scale, first_from_estimate.rotation, scale * first_from_estimate.translation);
  const Rigid3d& reference_from_first = reference.front();
  return {Sim3d(1.0, reference_from_first.rotation, reference_from_first.translation) * scaled,
          AlignmentFailure::kNone};
}

}  // namespace

std::string_view Name(AlignmentMode mode) {
  return kAlignmentModeNames[static_cast<std::size_t>(mode)];
}

std::string_view Explain(AlignmentFailure failure) {
  switch (failure) {
    case AlignmentFailure::kNone:
      return "The trajectories were aligned.";
    case AlignmentFailure::kTooFewPoses:
      return "Too few paired poses to align the trajectories.";
    case AlignmentFailure::kNoExtent:
      return "All positions of a trajectory are equal, so nothing fixes the alignment.";
    case AlignmentFailure::kCollinear:
      return "The positions lie on one line, so the rotation about it is undetermined.";
    case AlignmentFailure::kScaleNotPositive:
      return "The trajectories move in opposite directions, so no positive scale fits.";
  }
  return "unknown";
}

Alignment AlignPositions(std::span<const Eigen::Vector3d> estimate,
                         std::span<const Eigen::Vector3d> reference, ScaleFit scale_fit) {
  LIFT_SLAM_CHECK(estimate.size() == reference.size(), "{} estimated and {} reference positions",
                  estimate.size(), reference.size());
  if (estimate.size() < kMinPositions) return Failure(AlignmentFailure::kTooFewPoses);
  const double inverse_n = 1.0 / static_cast<double>(estimate.size());
  const Eigen::Vector3d mean_x = Mean(estimate);
  const Eigen::Vector3d mean_y = Mean(reference);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance_x = 0.0;
  double variance_y = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Eigen::Vector3d x = estimate[i] - mean_x;
    const Eigen::Vector3d y = reference[i] - mean_y;
    covariance += inverse_n * y * x.transpose();
    variance_x += inverse_n * x.squaredNorm();
    variance_y += inverse_n * y.squaredNorm();
  }
  if (!HasExtent(variance_x, mean_x) || !HasExtent(variance_y, mean_y)) {
    return Failure(AlignmentFailure::kNoExtent);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& d = svd.singularValues();
  if (!(d(0) > 0.0)) return Failure(AlignmentFailure::kNoExtent);
  if (d(1) <= kMinSingularValueRatio * d(0)) return Failure(AlignmentFailure::kCollinear);
  Eigen::Vector3d s = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s(2) = -1.0;
  const Eigen::Matrix3d rotation = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  const double scale = scale_fit == ScaleFit::kFree ? d.dot(s) / variance_x : 1.0;
  return {Sim3d(scale, Eigen::Quaterniond(rotation), mean_y - scale * (rotation * mean_x)),
          AlignmentFailure::kNone};
}

Alignment AlignPoses(std::span<const Rigid3d> estimate, std::span<const Rigid3d> reference,
                     AlignmentMode mode) {
  LIFT_SLAM_CHECK(estimate.size() == reference.size(), "{} estimated and {} reference poses",
                  estimate.size(), reference.size());
  if (mode == AlignmentMode::kNone) return {Sim3d(), AlignmentFailure::kNone};
  if (estimate.empty()) return Failure(AlignmentFailure::kTooFewPoses);
  switch (mode) {
    case AlignmentMode::kOrigin: {
      const Rigid3d motion = OriginAlignment(estimate, reference);
      return {Sim3d(1.0, motion.rotation, motion.translation), AlignmentFailure::kNone};
    }
    case AlignmentMode::kScale:
      return AlignScale(estimate, reference);
    case AlignmentMode::kSe3:
      return AlignPositions(Positions(estimate), Positions(reference), ScaleFit::kFixed);
    default:
      break;
  }
  Alignment alignment = AlignPositions(Positions(estimate), Positions(reference), ScaleFit::kFree);
  if (alignment.reference_from_estimate && mode == AlignmentMode::kScaleSim3) {
    alignment.reference_from_estimate =
        Sim3d(alignment.reference_from_estimate->scale, Eigen::Quaterniond::Identity(),
              Eigen::Vector3d::Zero());
  }
  return alignment;
}

}  // namespace lift_slam
