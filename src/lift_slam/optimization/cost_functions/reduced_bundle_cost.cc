#include "lift_slam/optimization/cost_functions/reduced_bundle_cost.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lift_slam/optimization/min_depth.h"

namespace lift_slam {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

// Damping of a point relative to its information: keeps the system of a point without parallax
// solvable; far below the share of the depth, about (baseline / depth)^2.
constexpr double kPointDamping = 1e-10;

// A point's step that makes its loss worse is shortened by this factor, at most so many times:
// points without much parallax overshoot, and one that stayed put would hold the cameras back.
constexpr double kShortening = 0.25;
constexpr int kMaxShortenings = 3;

struct Loss {
  double value = 0.0;  // rho
  double slope = 0.0;  // rho'
};

// Huber: rho' = min(1, width / sqrt(e)), rho = e rho' (2 - rho').
inline Loss Huber(double squared_error, double width) {
  const double slope = squared_error > width * width ? width / std::sqrt(squared_error) : 1.0;
  return {squared_error * slope * (2.0 - slope), slope};
}

Eigen::Matrix3d DampedInverse(const Eigen::Matrix3d& hessian) {
  const double damping = kPointDamping * hessian.trace();
  if (!(damping > 0.0)) return Eigen::Matrix3d::Zero();  // behind all its cameras: it stays
  return (hessian + damping * Eigen::Matrix3d::Identity()).inverse();
}

// One observation linearised. by_camera lacks LeftJacobianSo3, see ApplyRotationChain().
struct Linearized {
  Eigen::Vector2d error;  // pixels
  Matrix23 by_point;
  Matrix26 by_camera;   // set for free cameras
  double weight = 0.0;  // inverse variance times rho'
  double loss = 0.0;
};

// d pixel / d x_in_cam = [a0 0 a2; 0 b1 b2]; d x_in_cam / d x_in_world = R,
// / d w = -[x_in_cam - d]x J_l(w), / d d = I.
inline Linearized LinearizeObservation(const ReducedBundleOptions& options,
                                       const CameraBlock& camera,
                                       const ReducedObservation& observation,
                                       const Eigen::Vector3d& x_in_cam) {
  const PinholeIntrinsics& k = options.intrinsics;
  const double inverse_z = 1.0 / x_in_cam.z();
  const double x = x_in_cam.x() * inverse_z, y = x_in_cam.y() * inverse_z;
  Linearized result;
  result.error << k.fx * x + k.cx - observation.u, k.fy * y + k.cy - observation.v;
  const Loss loss = Huber(observation.weight * result.error.squaredNorm(), options.huber_width);
  result.loss = loss.value;
  result.weight = observation.weight * loss.slope;
  const double a0 = k.fx * inverse_z, a2 = -a0 * x, b1 = k.fy * inverse_z, b2 = -b1 * y;
  const Eigen::Matrix3d& rotation = camera.rotation();
  result.by_point.row(0) = a0 * rotation.row(0) + a2 * rotation.row(2);
  result.by_point.row(1) = b1 * rotation.row(1) + b2 * rotation.row(2);
  if (observation.free_camera < 0) return result;
  const Eigen::Vector3d r = x_in_cam - camera.shift();
  result.by_camera << r.y() * a2, r.z() * a0 - r.x() * a2, -r.y() * a0, a0, 0.0, a2,
      r.y() * b2 - r.z() * b1, -r.x() * b2, r.x() * b1, 0.0, b1, b2;
  return result;
}

}  // namespace

ReducedBundleCost::ReducedBundleCost(const ReducedBundleOptions& options,
                                     std::vector<CameraBlock>& cameras,
                                     const std::vector<int>& free_cameras,
                                     const std::vector<ReducedObservation>& observations,
                                     const std::vector<ReducedPoint>& ranges,
                                     std::vector<Eigen::Vector3d>& points)
    : options_(options),
      cameras_(cameras),
      free_cameras_(free_cameras),
      observations_(observations),
      ranges_(ranges),
      points_(points),
      trial_points_(points),
      systems_(ranges.size()),
      point_camera_blocks_(observations.size()),
      rotation_chains_(free_cameras.size()) {}

bool ReducedBundleCost::operator()(const double* parameters, double* residuals,
                                   double* jacobian) const {
  const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(parameters, NumParameters());
  if (jacobian != nullptr) {
    Accept(values);
    linearized_parameters_ = values;
    WriteCompressed(Linearize(), residuals, jacobian);
    return true;
  }
  Eigen::Map<Eigen::VectorXd> all(residuals, NumResiduals());
  all.setZero();
  const bool is_late = 1e-3 * timer_.ElapsedMs() > options_.max_time_s;
  all[NumParameters()] =
      is_late ? std::numeric_limits<double>::infinity() : std::sqrt(TrialSquaredNorm(values));
  return true;
}

void ReducedBundleCost::Accept(const Eigen::VectorXd& parameters) const {
  SetCameras(parameters);
  if (trial_parameters_.size() > 0 && parameters == trial_parameters_) points_ = trial_points_;
}

void ReducedBundleCost::SetCameras(const Eigen::VectorXd& parameters) const {
  for (std::size_t i = 0; i < free_cameras_.size(); ++i) {
    CameraBlock& camera = cameras_[static_cast<std::size_t>(free_cameras_[i])];
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(camera.parameters()) =
        parameters.segment<6>(6 * static_cast<Eigen::Index>(i));
    camera.Update();
  }
}

const NormalEquations<Eigen::Dynamic>& ReducedBundleCost::Linearize() const {
  equations_.hessian.setZero(NumParameters(), NumParameters());
  equations_.gradient.setZero(NumParameters());
  equations_.squared_norm = 0.0;
  for (std::size_t i = 0; i < ranges_.size(); ++i) LinearizePoint(i);
  ApplyRotationChain();
  equations_.hessian.triangularView<Eigen::StrictlyUpper>() = equations_.hessian.transpose();
  return equations_;
}

void ReducedBundleCost::LinearizePoint(std::size_t range) const {
  const ReducedPoint& seen = ranges_[range];
  const Eigen::Vector3d& point = points_[static_cast<std::size_t>(seen.point)];
  PointSystem& system = systems_[range];
  system.gradient.setZero();
  system.loss = 0.0;
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  for (int i = seen.begin; i < seen.end; ++i) {
    const ReducedObservation& observation = observations_[static_cast<std::size_t>(i)];
    const CameraBlock& camera = cameras_[static_cast<std::size_t>(observation.camera)];
    Matrix36& point_camera = point_camera_blocks_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d x_in_cam = camera.rotation() * point + camera.translation();
    if (!(x_in_cam.z() > kMinDepth)) {
      system.loss += Huber(kBehindSquaredError, options_.huber_width).value;
      point_camera.setZero();
      continue;
    }
    const Linearized l = LinearizeObservation(options_, camera, observation, x_in_cam);
    system.loss += l.loss;
    const Matrix23 weighted = l.weight * l.by_point;
    hessian.noalias() += weighted.transpose().lazyProduct(l.by_point);
    system.gradient.noalias() += weighted.transpose().lazyProduct(l.error);
    if (observation.free_camera < 0) continue;
    point_camera.noalias() = weighted.transpose().lazyProduct(l.by_camera);
    const Matrix26 weighted_by_camera = l.weight * l.by_camera;
    const Eigen::Index first = 6 * static_cast<Eigen::Index>(observation.free_camera);
    equations_.hessian.block<6, 6>(first, first).noalias() +=
        weighted_by_camera.transpose().lazyProduct(l.by_camera);
    equations_.gradient.segment<6>(first).noalias() +=
        weighted_by_camera.transpose().lazyProduct(l.error);
  }
  equations_.squared_norm += system.loss;
  system.inverse_hessian = DampedInverse(hessian);
  EliminatePoint(range, system);
}

void ReducedBundleCost::EliminatePoint(std::size_t range, const PointSystem& system) const {
  const ReducedPoint& seen = ranges_[range];
  const Eigen::Vector3d step = system.inverse_hessian * system.gradient;
  for (int i = seen.begin; i < seen.end; ++i) {
    const int camera = observations_[static_cast<std::size_t>(i)].free_camera;
    if (camera < 0) continue;
    const Matrix36& block = point_camera_blocks_[static_cast<std::size_t>(i)];
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(camera);
    equations_.gradient.segment<6>(row).noalias() -= block.transpose().lazyProduct(step);
    const Matrix36 solved = system.inverse_hessian.lazyProduct(block);
    for (int j = seen.begin; j <= i; ++j) {
      const int other = observations_[static_cast<std::size_t>(j)].free_camera;
      if (other < 0) continue;
      equations_.hessian.block<6, 6>(row, 6 * static_cast<Eigen::Index>(other)).noalias() -=
          solved.transpose().lazyProduct(point_camera_blocks_[static_cast<std::size_t>(j)]);
    }
  }
}

// d / d w = (d / d rotation) J_l(w) for each camera.
void ReducedBundleCost::ApplyRotationChain() const {
  for (std::size_t i = 0; i < free_cameras_.size(); ++i) {
    const Eigen::Matrix3d chain =
        cameras_[static_cast<std::size_t>(free_cameras_[i])].left_jacobian();
    rotation_chains_[i] = chain;
    const auto first = 6 * static_cast<Eigen::Index>(i);
    auto rows = equations_.hessian.middleRows<3>(first);
    rows = (chain.transpose() * rows).eval();
    auto columns = equations_.hessian.middleCols<3>(first);
    columns = (columns * chain).eval();
    equations_.gradient.segment<3>(first) =
        (chain.transpose() * equations_.gradient.segment<3>(first)).eval();
  }
}

double ReducedBundleCost::TrialSquaredNorm(const Eigen::VectorXd& parameters) const {
  SetCameras(parameters);
  trial_parameters_ = parameters;
  Eigen::VectorXd camera_steps = parameters - linearized_parameters_;
  for (std::size_t i = 0; i < free_cameras_.size(); ++i) {
    auto rotation_step = camera_steps.segment<3>(6 * static_cast<Eigen::Index>(i));
    rotation_step = (rotation_chains_[i] * rotation_step).eval();
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < ranges_.size(); ++i) sum += MovePoint(i, camera_steps);
  return sum;
}

double ReducedBundleCost::MovePoint(std::size_t range, const Eigen::VectorXd& camera_steps) const {
  const ReducedPoint& seen = ranges_[range];
  const Eigen::Vector3d& start = points_[static_cast<std::size_t>(seen.point)];
  Eigen::Vector3d& trial = trial_points_[static_cast<std::size_t>(seen.point)];
  Eigen::Vector3d step = PointStep(range, camera_steps);
  trial = start + step;
  double loss = PointLoss(seen, trial);
  if (loss <= systems_[range].loss) return loss;
  const double unmoved_loss = PointLoss(seen, start);
  for (int i = 0; i < kMaxShortenings && !(loss <= unmoved_loss); ++i) {
    step *= kShortening;
    trial = start + step;
    loss = PointLoss(seen, trial);
  }
  if (loss <= unmoved_loss) return loss;
  trial = start;
  return unmoved_loss;
}

Eigen::Vector3d ReducedBundleCost::PointStep(std::size_t range,
                                             const Eigen::VectorXd& camera_steps) const {
  const ReducedPoint& seen = ranges_[range];
  Eigen::Vector3d gradient = systems_[range].gradient;
  for (int i = seen.begin; i < seen.end; ++i) {
    const int camera = observations_[static_cast<std::size_t>(i)].free_camera;
    if (camera < 0) continue;
    gradient.noalias() += point_camera_blocks_[static_cast<std::size_t>(i)].lazyProduct(
        camera_steps.segment<6>(6 * static_cast<Eigen::Index>(camera)));
  }
  return -systems_[range].inverse_hessian * gradient;
}

double ReducedBundleCost::PointLoss(const ReducedPoint& range, const Eigen::Vector3d& point) const {
  double sum = 0.0;
  for (int i = range.begin; i < range.end; ++i) {
    const ReducedObservation& observation = observations_[static_cast<std::size_t>(i)];
    const CameraBlock& camera = cameras_[static_cast<std::size_t>(observation.camera)];
    const Eigen::Vector3d x_in_cam = camera.rotation() * point + camera.translation();
    double squared_error = kBehindSquaredError;
    if (x_in_cam.z() > kMinDepth) {
      const Eigen::Vector2d pixel(observation.u, observation.v);
      squared_error =
          observation.weight * (options_.intrinsics.Project(x_in_cam) - pixel).squaredNorm();
    }
    sum += Huber(squared_error, options_.huber_width).value;
  }
  return sum;
}

}  // namespace lift_slam
