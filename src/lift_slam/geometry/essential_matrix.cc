#include "lift_slam/geometry/essential_matrix.h"

#include <Eigen/Dense>
#include <cmath>

#include "lift_slam/geometry/epipolar.h"

namespace lift_slam {
namespace {

// Polynomials in x, y, z by their coefficients in the order
// degree 1: x y z 1
// degree 2: x^2 xy y^2 xz yz z^2 | x y z 1
// degree 3: x^3 x^2y xy^2 y^3 x^2z xyz y^2z xz^2 yz^2 z^3 | the ten of degree 2
using Linear = Eigen::Matrix<double, 1, 4>;
using Quadratic = Eigen::Matrix<double, 1, 10>;
using Cubic = Eigen::Matrix<double, 1, 20>;
constexpr int kQuadraticIndex[4][4] = {{0, 1, 3, 6}, {1, 2, 4, 7}, {3, 4, 5, 8}, {6, 7, 8, 9}};
constexpr int kCubicIndex[10][4] = {
    {0, 1, 4, 10}, {1, 2, 5, 11},    {2, 3, 6, 12},    {4, 5, 7, 13},    {5, 6, 8, 14},
    {7, 8, 9, 15}, {10, 11, 13, 16}, {11, 12, 14, 17}, {13, 14, 15, 18}, {16, 17, 18, 19}};

Quadratic Multiply(const Linear& a, const Linear& b) {
  Quadratic product = Quadratic::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) product[kQuadraticIndex[i][j]] += a[i] * b[j];
  }
  return product;
}

Cubic Multiply(const Quadratic& a, const Linear& b) {
  Cubic product = Cubic::Zero();
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 4; ++j) product[kCubicIndex[i][j]] += a[i] * b[j];
  }
  return product;
}

// Columns: X, Y, Z, W as row-major 3x3 matrices, a basis of all matrices that fulfil the five
// epipolar equations.
Eigen::Matrix<double, 9, 4> NullSpace(const std::array<const NormalizedMatch*, 5>& matches) {
  Eigen::Matrix<double, 9, 5> equations;
  for (int i = 0; i < 5; ++i) {
    const NormalizedMatch& match = *matches[static_cast<std::size_t>(i)];
    const Eigen::Vector3d x1 = match.in_image1.homogeneous();
    const Eigen::Vector3d x2 = match.in_image2.homogeneous();
    for (int k = 0; k < 3; ++k) equations.col(i).segment<3>(3 * k) = x2[k] * x1;
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 5>> qr(equations);
  const Eigen::Matrix<double, 9, 9> q = qr.householderQ();
  return q.rightCols<4>();
}

// det E = 0 and 2 E E^T E - trace(E E^T) E = 0 as ten cubic polynomials.
Eigen::Matrix<double, 10, 20> CubicConstraints(const Eigen::Matrix<double, 9, 4>& basis) {
  Linear e[3][3];
  for (int i = 0; i < 9; ++i) e[i / 3][i % 3] = basis.row(i);
  Quadratic products[3][3];  // E E^T
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      products[i][j] =
          Multiply(e[i][0], e[j][0]) + Multiply(e[i][1], e[j][1]) + Multiply(e[i][2], e[j][2]);
      products[j][i] = products[i][j];
    }
  }
  const Quadratic half_trace = 0.5 * (products[0][0] + products[1][1] + products[2][2]);
  for (int i = 0; i < 3; ++i) products[i][i] -= half_trace;
  Eigen::Matrix<double, 10, 20> constraints;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      constraints.row(3 * i + j) = Multiply(products[i][0], e[0][j]) +
                                   Multiply(products[i][1], e[1][j]) +
                                   Multiply(products[i][2], e[2][j]);
    }
  }
  constraints.row(9) =
      Multiply(Quadratic(Multiply(e[1][1], e[2][2]) - Multiply(e[1][2], e[2][1])), e[0][0]) +
      Multiply(Quadratic(Multiply(e[1][2], e[2][0]) - Multiply(e[1][0], e[2][2])), e[0][1]) +
      Multiply(Quadratic(Multiply(e[1][0], e[2][1]) - Multiply(e[1][1], e[2][0])), e[0][2]);
  return constraints;
}

// Multiplication by x in the quotient ring with basis x^2 xy y^2 xz yz z^2 x y z 1.
Eigen::Matrix<double, 10, 10> ActionMatrix(const Eigen::Matrix<double, 10, 20>& constraints) {
  const Eigen::Matrix<double, 10, 10> reduced =
      constraints.leftCols<10>().partialPivLu().solve(constraints.rightCols<10>());
  Eigen::Matrix<double, 10, 10> action = Eigen::Matrix<double, 10, 10>::Zero();
  constexpr int kCubicRows[6] = {0, 1, 2, 4, 5, 7};
  for (int i = 0; i < 6; ++i) action.row(i) = -reduced.row(kCubicRows[i]);
  action(6, 0) = action(7, 1) = action(8, 3) = action(9, 6) = 1.0;
  return action;
}

// Two unit vectors that span the plane perpendicular to a unit vector.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

// A residual is the signed Sampson error in sigmas; its derivative is by the entries of E.
struct SampsonTerm {
  double residual = 0.0;
  Eigen::Matrix3d by_essential;
};

SampsonTerm EvaluateSampson(const Eigen::Matrix3d& essential, const NormalizedMatch& match) {
  const Eigen::Vector3d x1 = match.in_image1.homogeneous();
  const Eigen::Vector3d x2 = match.in_image2.homogeneous();
  Eigen::Vector3d line2 = essential * x1;
  Eigen::Vector3d line1 = essential.transpose() * x2;
  const double algebraic = x2.dot(line2);
  line1.z() = line2.z() = 0.0;
  const double inverse = 1.0 / std::sqrt(line1.squaredNorm() + line2.squaredNorm());
  SampsonTerm term;
  term.residual = algebraic * inverse / match.sigma;
  // d (c / s) = dc / s - c / s^3 * (line2 . d line2 + line1 . d line1)
  term.by_essential =
      (x2 * x1.transpose() -
       (algebraic * inverse * inverse) * (line2 * x1.transpose() + x2 * line1.transpose())) *
      (inverse / match.sigma);
  return term;
}

struct NormalEquations {
  Eigen::Matrix<double, 5, 5> hessian = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
};

double TruncatedCost(std::span<const NormalizedMatch> matches, const Rigid3d& pose,
                     double max_squared_error) {
  const Eigen::Matrix3d essential = EssentialMatrix(pose);
  double cost = 0.0;
  for (const NormalizedMatch& match : matches) {
    const double error = SquaredSampsonError(essential, match.in_image1, match.in_image2);
    cost += std::min(error / (match.sigma * match.sigma), max_squared_error);
  }
  return cost;
}

// Parameters: rotation R <- exp([w]x) R (3), then translation t <- t + basis * d (2).
NormalEquations Linearize(std::span<const NormalizedMatch> matches, const Rigid3d& pose,
                          double max_squared_error) {
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  const Eigen::Matrix3d cross = CrossMatrix(pose.translation);
  const Eigen::Matrix<double, 3, 2> basis = TangentBasis(pose.translation);
  Eigen::Matrix<double, 9, 5> by_parameters;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix3d derivative =
        i < 3 ? Eigen::Matrix3d(cross * CrossMatrix(Eigen::Vector3d::Unit(i)) * rotation)
              : Eigen::Matrix3d(CrossMatrix(basis.col(i - 3)) * rotation);
    by_parameters.col(i) = derivative.reshaped();
  }
  const Eigen::Matrix3d essential = cross * rotation;
  NormalEquations equations;
  for (const NormalizedMatch& match : matches) {
    const SampsonTerm term = EvaluateSampson(essential, match);
    if (!(term.residual * term.residual < max_squared_error)) continue;
    const Eigen::Matrix<double, 5, 1> jacobian =
        by_parameters.transpose() * term.by_essential.reshaped();
    equations.hessian.noalias() += jacobian * jacobian.transpose();
    equations.gradient.noalias() += jacobian * term.residual;
  }
  return equations;
}

Rigid3d ApplyStep(const Rigid3d& pose, const Eigen::Matrix<double, 5, 1>& step) {
  const Eigen::Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  const Eigen::Quaterniond rotation =
      angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * pose.rotation
                  : pose.rotation;
  const Eigen::Vector3d moved = pose.translation + TangentBasis(pose.translation) * step.tail<2>();
  return {rotation, moved.normalized()};
}

}  // namespace

std::vector<Eigen::Matrix3d> SolveFivePoint(const std::array<const NormalizedMatch*, 5>& matches) {
  const Eigen::Matrix<double, 9, 4> basis = NullSpace(matches);
  const Eigen::Matrix<double, 10, 10> action = ActionMatrix(CubicConstraints(basis));
  std::vector<Eigen::Matrix3d> solutions;
  if (!action.allFinite()) return solutions;  // degenerate sample
  const Eigen::EigenSolver<Eigen::Matrix<double, 10, 10>> solver(action);
  if (solver.info() != Eigen::Success) return solutions;
  for (int i = 0; i < 10; ++i) {
    if (solver.eigenvalues()[i].imag() != 0.0) continue;
    const Eigen::Vector4d weights = solver.eigenvectors().col(i).tail<4>().real();
    const Eigen::Matrix<double, 9, 1> entries = (basis * weights).normalized();
    if (entries.allFinite()) solutions.push_back(entries.reshaped<Eigen::RowMajor>(3, 3));
  }
  return solutions;
}

std::array<Rigid3d, 4> DecomposeEssential(const Eigen::Matrix3d& essential) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() < 0.0) u.col(2) *= -1.0;
  if (v.determinant() < 0.0) v.col(2) *= -1.0;
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Eigen::Matrix3d rotation_a = u * w * v.transpose();
  const Eigen::Matrix3d rotation_b = u * w.transpose() * v.transpose();
  const Eigen::Vector3d t = u.col(2);
  return {Rigid3d(rotation_a, t), Rigid3d(rotation_a, -t), Rigid3d(rotation_b, t),
          Rigid3d(rotation_b, -t)};
}

Rigid3d RefineRelativePose(std::span<const NormalizedMatch> matches, const Rigid3d& cam2_from_cam1,
                           double max_squared_error, int max_iterations) {
  Rigid3d pose(cam2_from_cam1.rotation, cam2_from_cam1.translation.normalized());
  double cost = TruncatedCost(matches, pose, max_squared_error);
  NormalEquations equations = Linearize(matches, pose, max_squared_error);
  double damping = 1e-4;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::Matrix<double, 5, 5> damped = equations.hessian;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-12;
    const Eigen::Matrix<double, 5, 1> step = -damped.ldlt().solve(equations.gradient);
    if (!step.allFinite() || step.norm() < 1e-9) break;
    const Rigid3d candidate = ApplyStep(pose, step);
    const double candidate_cost = TruncatedCost(matches, candidate, max_squared_error);
    if (!(candidate_cost < cost)) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const bool converged = cost - candidate_cost < 1e-6 * cost;
    pose = candidate;
    cost = candidate_cost;
    if (converged) break;
    damping = std::max(damping * 0.1, 1e-9);
    equations = Linearize(matches, pose, max_squared_error);
  }
  return pose;
}

}  // namespace lift_slam
