#include "lift_slam/optimization/cost_functions/pose_cost.h"

#include <array>
#include <cmath>
#include <limits>

#include "lift_slam/optimization/min_depth.h"
#include "lift_slam/optimization/so3.h"

namespace lift_slam {
namespace {

using Lanes = Eigen::Array<double, PoseObservationArrays::kLanes, 1>;
using LanesMap = Eigen::Map<const Lanes>;

// A pose as the inner loops need it: rotated = rotation * x_in_world + offset,
// x_in_cam = rotated + shift.
struct Motion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d offset;
  Eigen::Vector3d shift;
};

Motion MakeMotion(const Rigid3d& base, const Eigen::Matrix<double, 6, 1>& parameters) {
  const Eigen::Quaterniond change = ExpSo3(parameters.head<3>());
  return {(change * base.rotation).toRotationMatrix(), change * base.translation,
          parameters.tail<3>()};
}

// Four observations under a motion.
struct Group {
  Lanes rotated_x, rotated_y, rotated_z;  // Exp(w) (base * x_in_world)
  Lanes x, y;                             // x_in_cam / z, y_in_cam / z
  Lanes inverse_z;
  Lanes error_u, error_v;  // pixels
  Lanes loss;              // rho, already weighted
  Lanes loss_weight;       // weight * rho'
  bool is_in_front = false;
};

inline Group Observe(const PinholeIntrinsics& intrinsics, const Motion& motion,
                     const PoseObservationArrays& data, std::size_t first, double huber_width) {
  const LanesMap x(&data.x[first]), y(&data.y[first]), z(&data.z[first]);
  const LanesMap u(&data.u[first]), v(&data.v[first]), weight(&data.weight[first]);
  const auto& r = motion.rotation;
  Group group;
  group.rotated_x = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + motion.offset.x();
  group.rotated_y = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + motion.offset.y();
  group.rotated_z = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + motion.offset.z();
  const Lanes depth = group.rotated_z + motion.shift.z();
  group.is_in_front = (depth > kMinDepth).all();
  group.inverse_z = depth.inverse();
  group.x = (group.rotated_x + motion.shift.x()) * group.inverse_z;
  group.y = (group.rotated_y + motion.shift.y()) * group.inverse_z;
  group.error_u = intrinsics.fx * group.x + intrinsics.cx - u;
  group.error_v = intrinsics.fy * group.y + intrinsics.cy - v;
  const Lanes error = weight * (group.error_u.square() + group.error_v.square());
  // rho' = min(1, width / sqrt(e)), rho = e rho' (2 - rho').
  const Lanes slope = (huber_width * error.rsqrt()).min(1.0);
  group.loss = error * slope * (2.0 - slope);
  group.loss_weight = weight * slope;
  return group;
}

// Sums over all observations, by lane.
struct Sums {
  std::array<std::array<Lanes, 6>, 6> hessian;  // columns <= row
  std::array<Lanes, 6> gradient;
  Lanes loss;
};

// Jacobians by [w, d] before LeftJacobianSo3. With a = d u / d x_in_cam: (rotated x a, a).
inline void Accumulate(const PinholeIntrinsics& intrinsics, const Group& group, Sums& sums) {
  const Lanes zero = Lanes::Zero();
  const Lanes a0 = intrinsics.fx * group.inverse_z, a2 = -a0 * group.x;
  const Lanes b1 = intrinsics.fy * group.inverse_z, b2 = -b1 * group.y;
  const std::array<Lanes, 6> row_u = {group.rotated_y * a2,
                                      group.rotated_z * a0 - group.rotated_x * a2,
                                      -group.rotated_y * a0,
                                      a0,
                                      zero,
                                      a2};
  const std::array<Lanes, 6> row_v = {group.rotated_y * b2 - group.rotated_z * b1,
                                      -group.rotated_x * b2,
                                      group.rotated_x * b1,
                                      zero,
                                      b1,
                                      b2};
  for (std::size_t i = 0; i < 6; ++i) {
    const Lanes weighted_u = group.loss_weight * row_u[i],
                weighted_v = group.loss_weight * row_v[i];
    sums.gradient[i] += weighted_u * group.error_u + weighted_v * group.error_v;
    for (std::size_t j = 0; j <= i; ++j) {
      sums.hessian[i][j] += weighted_u * row_u[j] + weighted_v * row_v[j];
    }
  }
  sums.loss += group.loss;
}

// The error of a prior: the expected centre in the camera's frame, where the centre is 0.
Eigen::Vector3d ExpectedInCam(const CenterPrior& prior, const Motion& motion) {
  return motion.rotation * prior.center_in_world + motion.offset + motion.shift;
}

double PriorCost(const CenterPrior& prior, const Motion& motion) {
  return prior.inverse_variance * ExpectedInCam(prior, motion).squaredNorm();
}

// Jacobian by [w, d] before LeftJacobianSo3, as in Accumulate.
void AddPrior(const CenterPrior& prior, const Motion& motion, NormalEquations<6>& equations) {
  if (!(prior.inverse_variance > 0.0)) return;
  const Eigen::Vector3d error = ExpectedInCam(prior, motion);
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -SkewSymmetric(error - motion.shift), Eigen::Matrix3d::Identity();
  equations.hessian += prior.inverse_variance * jacobian.transpose() * jacobian;
  equations.gradient += prior.inverse_variance * jacobian.transpose() * error;
  equations.squared_norm += PriorCost(prior, motion);
}

NormalEquations<6> ToNormalEquations(const Sums& sums, const CenterPrior& prior,
                                     const Motion& motion, const Eigen::Vector3d& rotation_change) {
  NormalEquations<6> equations;
  for (int i = 0; i < 6; ++i) {
    const auto row = static_cast<std::size_t>(i);
    equations.gradient[i] = sums.gradient[row].sum();
    for (int j = 0; j <= i; ++j) {
      equations.hessian(i, j) = sums.hessian[row][static_cast<std::size_t>(j)].sum();
      equations.hessian(j, i) = equations.hessian(i, j);
    }
  }
  equations.squared_norm = sums.loss.sum();
  AddPrior(prior, motion, equations);
  Eigen::Matrix<double, 6, 6> chain = Eigen::Matrix<double, 6, 6>::Identity();
  chain.topLeftCorner<3, 3>() = LeftJacobianSo3(rotation_change);
  equations.hessian = chain.transpose() * equations.hessian * chain;
  equations.gradient = chain.transpose() * equations.gradient;
  return equations;
}

}  // namespace

void PoseObservationArrays::Clear() {
  for (auto* values : {&x, &y, &z, &u, &v, &weight}) values->clear();
}

void PoseObservationArrays::Add(const PoseObservation& observation) {
  x.push_back(observation.point_in_world.x());
  y.push_back(observation.point_in_world.y());
  z.push_back(observation.point_in_world.z());
  u.push_back(observation.pixel.x());
  v.push_back(observation.pixel.y());
  weight.push_back(observation.inverse_variance);
}

void PoseObservationArrays::Pad() {
  while (x.size() % kLanes != 0) {
    for (auto* values : {&x, &y, &z, &u, &v}) values->push_back(values->front());
    weight.push_back(0.0);
  }
}

Rigid3d PoseCost::CamFromWorld(const Eigen::Matrix<double, 6, 1>& parameters) const {
  const Eigen::Quaterniond change = ExpSo3(parameters.head<3>());
  return {change * base_cam_from_world_.rotation,
          change * base_cam_from_world_.translation + parameters.tail<3>()};
}

double PoseCost::SquaredNorm(const Eigen::Matrix<double, 6, 1>& parameters) const {
  const Motion motion = MakeMotion(base_cam_from_world_, parameters);
  Lanes loss = Lanes::Zero();
  for (std::size_t i = 0; i < observations_.x.size(); i += PoseObservationArrays::kLanes) {
    const Group group = Observe(intrinsics_, motion, observations_, i, huber_width_);
    if (!group.is_in_front) return std::numeric_limits<double>::infinity();
    loss += group.loss;
  }
  return loss.sum() + PriorCost(prior_, motion);
}

NormalEquations<6> PoseCost::Evaluate(const Eigen::Matrix<double, 6, 1>& parameters) const {
  const Motion motion = MakeMotion(base_cam_from_world_, parameters);
  Sums sums;
  for (auto& row : sums.hessian) row.fill(Lanes::Zero());
  sums.gradient.fill(Lanes::Zero());
  sums.loss = Lanes::Zero();
  bool is_in_front = true;
  for (std::size_t i = 0; i < observations_.x.size(); i += PoseObservationArrays::kLanes) {
    const Group group = Observe(intrinsics_, motion, observations_, i, huber_width_);
    is_in_front = is_in_front && group.is_in_front;
    Accumulate(intrinsics_, group, sums);
  }
  NormalEquations<6> equations = ToNormalEquations(sums, prior_, motion, parameters.head<3>());
  if (!is_in_front) equations.squared_norm = std::numeric_limits<double>::infinity();
  return equations;
}

bool PoseCost::operator()(const double* parameters, double* residuals, double* jacobian) const {
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>> change(parameters);
  if (jacobian != nullptr) {
    WriteCompressed<6>(Evaluate(change), residuals, jacobian);
    return true;
  }
  Eigen::Map<Eigen::Matrix<double, 7, 1>> values(residuals);
  values.setZero();
  values[6] = std::sqrt(SquaredNorm(change));
  return true;
}

}  // namespace lift_slam
