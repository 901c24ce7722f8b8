#include "lift_slam/geometry/homography.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace lift_slam {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

// Singular values below this share of the largest count as zero.
constexpr double kSingular = 1e-9;

// x2 cross (H x1) = 0: two independent equations for each match, as columns.
Eigen::Matrix<double, 9, 2> Equations(const NormalizedMatch& match) {
  const Eigen::Vector3d x1 = match.in_image1.homogeneous();
  Eigen::Matrix<double, 9, 2> equations = Eigen::Matrix<double, 9, 2>::Zero();
  equations.col(0).segment<3>(0) = equations.col(1).segment<3>(3) = x1;
  equations.col(0).segment<3>(6) = -match.in_image2.x() * x1;
  equations.col(1).segment<3>(6) = -match.in_image2.y() * x1;
  return equations;
}

Matrix9 NormalMatrix(std::span<const NormalizedMatch> matches) {
  Matrix9 normal = Matrix9::Zero();
  for (const NormalizedMatch& match : matches) {
    const Eigen::Matrix<double, 9, 2> equations = Equations(match) / match.sigma;
    normal.noalias() += equations * equations.transpose();
  }
  return normal;
}

// Minimal case: the null space of eight equations, much cheaper than the eigenvectors.
std::optional<Vector9> SolveMinimal(std::span<const NormalizedMatch> matches) {
  Eigen::Matrix<double, 9, 8> equations;
  for (int i = 0; i < 4; ++i) {
    equations.middleCols<2>(2 * i) = Equations(matches[static_cast<std::size_t>(i)]);
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 8>> qr(equations);
  const Eigen::Matrix<double, 8, 1> diagonal = qr.matrixQR().diagonal().cwiseAbs();
  if (!(diagonal.minCoeff() > kSingular * diagonal.maxCoeff())) return std::nullopt;
  Vector9 last = Vector9::Unit(8);
  last.applyOnTheLeft(qr.householderQ());
  return last;
}

std::optional<Vector9> SolveLeastSquares(std::span<const NormalizedMatch> matches) {
  const Eigen::SelfAdjointEigenSolver<Matrix9> solver(NormalMatrix(matches));
  const auto& values = solver.eigenvalues();
  if (!(values[1] > kSingular * kSingular * values[8])) return std::nullopt;
  return Vector9(solver.eigenvectors().col(0));
}

// Scales a homography so that its middle singular value is 1 (a plane's R + t n^T / d).
Eigen::Matrix3d WithUnitMiddleSingularValue(const Eigen::Matrix3d& homography) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(homography);
  return homography / svd.singularValues()[1];
}

}  // namespace

std::optional<Eigen::Matrix3d> FitHomography(std::span<const NormalizedMatch> matches) {
  if (matches.size() < 4) return std::nullopt;
  const auto entries = matches.size() == 4 ? SolveMinimal(matches) : SolveLeastSquares(matches);
  if (!entries) return std::nullopt;
  Eigen::Matrix3d homography = entries->normalized().reshaped<Eigen::RowMajor>(3, 3);
  int positive = 0;
  for (const NormalizedMatch& match : matches) {
    const double side =
        match.in_image2.homogeneous().dot(homography * match.in_image1.homogeneous());
    positive += side > 0.0 ? 1 : -1;
  }
  if (positive < 0) homography = -homography;
  if (!(homography.determinant() > kSingular)) return std::nullopt;
  return homography;
}

double SquaredHomographyError(const Eigen::Matrix3d& homography,
                              const Eigen::Matrix3d& inverse_homography,
                              const NormalizedMatch& match) {
  const Eigen::Vector3d forward = homography * match.in_image1.homogeneous();
  const Eigen::Vector3d backward = inverse_homography * match.in_image2.homogeneous();
  if (!(forward.z() > 0.0) || !(backward.z() > 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const double error = (forward.head<2>() / forward.z() - match.in_image2).squaredNorm() +
                       (backward.head<2>() / backward.z() - match.in_image1).squaredNorm();
  return 0.25 * error / (match.sigma * match.sigma);
}

std::vector<Rigid3d> DecomposeHomography(const Eigen::Matrix3d& homography) {
  const Eigen::Matrix3d h = WithUnitMiddleSingularValue(homography);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(h.transpose() * h);
  const double largest = solver.eigenvalues()[2];
  const double smallest = solver.eigenvalues()[0];
  std::vector<Rigid3d> poses;
  if (!(largest - smallest > kSingular)) return poses;
  const Eigen::Vector3d v1 = solver.eigenvectors().col(2);
  const Eigen::Vector3d v2 = solver.eigenvectors().col(1);
  const Eigen::Vector3d v3 = solver.eigenvectors().col(0);
  const double a = std::sqrt(std::max(0.0, 1.0 - smallest) / (largest - smallest));
  const double b = std::sqrt(std::max(0.0, largest - 1.0) / (largest - smallest));
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector3d u = (a * v1 + sign * b * v3).normalized();
    const Eigen::Vector3d normal = v2.cross(u);
    Eigen::Matrix3d from, to;
    from << v2, u, normal;
    to << h * v2, h * u, (h * v2).cross(h * u);
    const Eigen::Matrix3d rotation = to * from.transpose();
    const Eigen::Vector3d translation = (h - rotation) * normal;
    if (!(translation.norm() > kSingular)) continue;
    poses.emplace_back(rotation, translation.normalized());
    poses.emplace_back(rotation, -translation.normalized());
  }
  return poses;
}

Eigen::Matrix3d FitRotation(std::span<const NormalizedMatch> matches) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const NormalizedMatch& match : matches) {
    const Eigen::Vector3d ray1 = match.in_image1.homogeneous().normalized();
    const Eigen::Vector3d ray2 = match.in_image2.homogeneous().normalized();
    correlation.noalias() += ray2 * ray1.transpose() / (match.sigma * match.sigma);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

double SquaredRotationError(const Eigen::Matrix3d& rotation, const NormalizedMatch& match) {
  const Eigen::Vector3d rotated = rotation * match.in_image1.homogeneous();
  if (!(rotated.z() > 0.0)) return std::numeric_limits<double>::infinity();
  return 0.5 * (rotated.head<2>() / rotated.z() - match.in_image2).squaredNorm() /
         (match.sigma * match.sigma);
}

}  // namespace lift_slam
