#include "lift_slam/geometry/absolute_pose.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/epipolar.h"
#include "lift_slam/geometry/p3p.h"
#include "lift_slam/geometry/ransac.h"
#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kSampleRefineIterations = 3;
constexpr int kFinalRefineIterations = 10;
// Errors up to 3 sigma pull while refining.
constexpr double kMaxRefineSquaredError = 9.0;

double SquaredErrorInSigmas(const Rigid3d& cam_from_world, const PointMatch& match,
                            double focal_length_px) {
  const double scale = focal_length_px / match.sigma_px;
  return scale * scale *
         SquaredReprojectionError(cam_from_world, match.point_in_world, match.normalized);
}

struct ScoredPose {
  Rigid3d cam_from_world;
  double score = 0.0;
  int inliers = 0;
};

ScoredPose Score(std::span<const PointMatch> matches, double focal_length_px,
                 const Rigid3d& cam_from_world) {
  ScoredPose scored{cam_from_world};
  for (const PointMatch& match : matches) {
    const double error = SquaredErrorInSigmas(cam_from_world, match, focal_length_px);
    if (!(error < kChiSquare95With2Dof)) continue;
    scored.score += kChiSquare95With2Dof - error;
    ++scored.inliers;
  }
  return scored;
}

double TruncatedCost(std::span<const PointMatch> matches, double focal_length_px,
                     const Rigid3d& pose, double max_squared_error) {
  double cost = 0.0;
  for (const PointMatch& match : matches) {
    cost += std::min(SquaredErrorInSigmas(pose, match, focal_length_px), max_squared_error);
  }
  return cost;
}

struct NormalEquations {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
};

// Parameters: x_in_cam <- exp([w]x) x_in_cam + d; the order is (w, d).
NormalEquations Linearize(std::span<const PointMatch> matches, double focal_length_px,
                          const Rigid3d& pose, double max_squared_error) {
  NormalEquations equations;
  for (const PointMatch& match : matches) {
    const Eigen::Vector3d x = pose * match.point_in_world;
    if (!(x.z() > 0.0)) continue;
    const double scale = focal_length_px / match.sigma_px;
    const Eigen::Vector2d residual = scale * (x.head<2>() / x.z() - match.normalized);
    if (!(residual.squaredNorm() < max_squared_error)) continue;
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1.0, 0.0, -x.x() / x.z(), 0.0, 1.0, -x.y() / x.z();
    by_point *= scale / x.z();
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>().noalias() = -by_point * CrossMatrix(x);
    jacobian.rightCols<3>() = by_point;
    equations.hessian.noalias() += jacobian.transpose() * jacobian;
    equations.gradient.noalias() += jacobian.transpose() * residual;
  }
  return equations;
}

Rigid3d ApplyStep(const Rigid3d& pose, const Vector6& step) {
  const Eigen::Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  if (angle > 0.0) rotation = Eigen::AngleAxisd(angle, turn / angle);
  return {rotation * pose.rotation, rotation * pose.translation + step.tail<3>()};
}

std::vector<Rigid3d> SolveSample(std::span<const PointMatch> matches, Random& random) {
  const auto indices = DrawSample<3>(random, matches.size());
  std::array<Eigen::Vector3d, 3> points, rays;
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = matches[indices[i]].point_in_world;
    rays[i] = matches[indices[i]].normalized.homogeneous().normalized();
  }
  return SolveP3p(points, rays);
}

ScoredPose FindBestPose(std::span<const PointMatch> matches, double focal_length_px,
                        const AbsolutePoseOptions& options, Random& random) {
  const RansacLimits limits{10, options.max_iterations, 0.999};
  ScoredPose best;
  int iterations = limits.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    for (const Rigid3d& pose : SolveSample(matches, random)) {
      ScoredPose scored = Score(matches, focal_length_px, pose);
      if (!(scored.score > best.score)) continue;
      const ScoredPose refined =
          Score(matches, focal_length_px,
                RefineAbsolutePose(matches, focal_length_px, pose, kMaxRefineSquaredError,
                                   kSampleRefineIterations));
      best = refined.score > scored.score ? refined : scored;
      iterations = RansacIterations(
          limits, static_cast<double>(best.inliers) / static_cast<double>(matches.size()), 3);
    }
  }
  return best;
}

}  // namespace

Rigid3d RefineAbsolutePose(std::span<const PointMatch> matches, double focal_length_px,
                           const Rigid3d& cam_from_world, double max_squared_error,
                           int max_iterations) {
  Rigid3d pose = cam_from_world;
  double cost = TruncatedCost(matches, focal_length_px, pose, max_squared_error);
  NormalEquations equations = Linearize(matches, focal_length_px, pose, max_squared_error);
  double damping = 1e-4;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Matrix6 damped = equations.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector6 step = -damped.ldlt().solve(equations.gradient);
    if (!step.allFinite()) break;
    const Rigid3d candidate = ApplyStep(pose, step);
    const double candidate_cost =
        TruncatedCost(matches, focal_length_px, candidate, max_squared_error);
    if (!(candidate_cost < cost)) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const bool converged = cost - candidate_cost < 1e-8 * cost;
    pose = candidate;
    cost = candidate_cost;
    if (converged) break;
    damping = std::max(damping * 0.1, 1e-9);
    equations = Linearize(matches, focal_length_px, pose, max_squared_error);
  }
  return pose;
}

std::optional<AbsolutePose> EstimateAbsolutePose(std::span<const PointMatch> matches,
                                                 double focal_length_px,
                                                 const AbsolutePoseOptions& options,
                                                 std::uint64_t seed) {
  LIFT_SLAM_CHECK(focal_length_px > 0.0, "focal length {} px", focal_length_px);
  const auto needed = static_cast<std::size_t>(std::max(options.min_inliers, 4));
  if (matches.size() < needed) return std::nullopt;
  Random random(seed);
  const ScoredPose best = FindBestPose(matches, focal_length_px, options, random);
  if (best.inliers < 4) return std::nullopt;
  AbsolutePose result;
  result.cam_from_world = RefineAbsolutePose(matches, focal_length_px, best.cam_from_world,
                                             kMaxRefineSquaredError, kFinalRefineIterations);
  for (const PointMatch& match : matches) {
    const bool inlier =
        SquaredErrorInSigmas(result.cam_from_world, match, focal_length_px) < kChiSquare95With2Dof;
    result.is_inlier.push_back(inlier ? 1 : 0);
    result.num_inliers += inlier ? 1 : 0;
  }
  const double min_by_ratio = options.min_inlier_ratio * static_cast<double>(matches.size());
  if (result.num_inliers < options.min_inliers || result.num_inliers < min_by_ratio) {
    return std::nullopt;
  }
  return result;
}

void AbsolutePoseOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_inliers", min_inliers, "matches that must agree on the pose");
  visitor.Field("min_inlier_ratio", min_inlier_ratio, "the same as a share of the matches");
  visitor.Field("max_iterations", max_iterations, "samples of three matches");
}

}  // namespace lift_slam
