#include "lift_slam/optimization/cost_functions/reprojection_cost.h"

#include <cmath>

#include "lift_slam/optimization/min_depth.h"
#include "lift_slam/optimization/so3.h"

namespace lift_slam {
namespace {

using RowMatrix23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowMatrix26 = Eigen::Matrix<double, 2, 6, Eigen::RowMajor>;

void WriteConstant(double value, double* residuals, double* point_jacobian,
                   double* camera_jacobian) {
  residuals[0] = residuals[1] = value;
  if (point_jacobian != nullptr) Eigen::Map<RowMatrix23>(point_jacobian).setZero();
  if (camera_jacobian != nullptr) Eigen::Map<RowMatrix26>(camera_jacobian).setZero();
}

// d residuals / d x_in_cam = inverse_sigma [fx/z 0 -fx x/z^2; 0 fy/z -fy y/z^2];
// d x_in_cam / d x_in_world = R, / d w = -[x_in_cam - d]x J_l(w), / d d = I.
void Evaluate(const ReprojectionTerm& term, const CameraBlock& camera, const double* point,
              double* residuals, double* point_jacobian, double* camera_jacobian) {
  const Eigen::Vector3d x_in_cam =
      camera.rotation() * Eigen::Map<const Eigen::Vector3d>(point) + camera.translation();
  if (!term.is_active || !(x_in_cam.z() > kMinDepth)) {
    WriteConstant(term.is_active ? std::sqrt(0.5 * kBehindSquaredError) : 0.0, residuals,
                  point_jacobian, camera_jacobian);
    return;
  }
  const double inverse_z = 1.0 / x_in_cam.z();
  const double x = x_in_cam.x() * inverse_z, y = x_in_cam.y() * inverse_z;
  const double fx = term.inverse_sigma * term.intrinsics.fx;
  const double fy = term.inverse_sigma * term.intrinsics.fy;
  residuals[0] = fx * x + term.inverse_sigma * (term.intrinsics.cx - term.pixel.x());
  residuals[1] = fy * y + term.inverse_sigma * (term.intrinsics.cy - term.pixel.y());
  RowMatrix23 by_x_in_cam;
  by_x_in_cam << fx * inverse_z, 0.0, -fx * x * inverse_z, 0.0, fy * inverse_z, -fy * y * inverse_z;
  if (point_jacobian != nullptr) {
    Eigen::Map<RowMatrix23>(point_jacobian).noalias() = by_x_in_cam.lazyProduct(camera.rotation());
  }
  if (camera_jacobian != nullptr) {
    Eigen::Map<RowMatrix26> jacobian(camera_jacobian);
    const Eigen::Vector3d rotated = x_in_cam - camera.shift();
    RowMatrix23 by_rotation;
    by_rotation.row(0) = rotated.cross(by_x_in_cam.row(0).transpose()).transpose();
    by_rotation.row(1) = rotated.cross(by_x_in_cam.row(1).transpose()).transpose();
    jacobian.leftCols<3>().noalias() = by_rotation.lazyProduct(camera.left_jacobian());
    jacobian.rightCols<3>() = by_x_in_cam;
  }
}

}  // namespace

CameraBlock::CameraBlock(const Rigid3d& base_cam_from_world)
    : base_cam_from_world_(base_cam_from_world) {
  Update();
}

void CameraBlock::Update() {
  const Eigen::Vector3d w = parameters_.head<3>();
  shift_ = parameters_.tail<3>();
  const Rigid3d cam_from_world = CamFromWorld();
  rotation_ = cam_from_world.RotationMatrix();
  translation_ = cam_from_world.translation;
  left_jacobian_ = LeftJacobianSo3(w);
}

Rigid3d CameraBlock::CamFromWorld() const {
  const Eigen::Quaterniond change = ExpSo3(parameters_.head<3>());
  return {change * base_cam_from_world_.rotation,
          change * base_cam_from_world_.translation + parameters_.tail<3>()};
}

bool ReprojectionCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  double* by_point = jacobians == nullptr ? nullptr : jacobians[0];
  double* by_camera = jacobians == nullptr ? nullptr : jacobians[1];
  lift_slam::Evaluate(term_, camera_, parameters[0], residuals, by_point, by_camera);
  return true;
}

bool FixedCameraReprojectionCost::Evaluate(double const* const* parameters, double* residuals,
                                           double** jacobians) const {
  double* by_point = jacobians == nullptr ? nullptr : jacobians[0];
  lift_slam::Evaluate(term_, camera_, parameters[0], residuals, by_point, nullptr);
  return true;
}

}  // namespace lift_slam
