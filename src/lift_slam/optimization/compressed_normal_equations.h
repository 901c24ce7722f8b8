#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace lift_slam {

// A least-squares problem of any number of residuals r with Jacobian J, reduced to its normal
// equations: hessian H = J^T J (both triangles), gradient g = J^T r, squared_norm |r|^2.
// With a robust loss rho, H = sum rho' J_i^T J_i, g = sum rho' J_i^T r_i, squared_norm = sum rho.
// kParameters may be Eigen::Dynamic.
template <int kParameters>
struct NormalEquations {
  Eigen::Matrix<double, kParameters, kParameters> hessian;
  Eigen::Matrix<double, kParameters, 1> gradient;
  double squared_norm = 0.0;
};

// Writes the smallest residual vector and Jacobian that have the same normal equations, so that a
// solver which wants residuals (ceres::TinySolver) works on one row more than parameters instead
// of thousands: with H = P^T L D L^T P,
//   J' = [D^1/2 L^T P; 0],  r' = [D^-1/2 L^-1 P g; sqrt(|r|^2 - |r'_head|^2)].
// Directions that H leaves free (D = 0) get zero rows. `jacobian` is column-major.
template <int kParameters>
void WriteCompressed(const NormalEquations<kParameters>& equations, double* residuals,
                     double* jacobian) {
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;
  constexpr int kRows = kParameters == Eigen::Dynamic ? Eigen::Dynamic : kParameters + 1;
  const Eigen::Index size = equations.gradient.size();
  const Eigen::LDLT<Matrix> factors(equations.hessian);
  const double max_diagonal = factors.vectorD().maxCoeff();
  Vector square_root(size), inverse_square_root(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double d = factors.vectorD()[i];
    const bool is_free = !(d > 1e-15 * max_diagonal);
    square_root[i] = is_free ? 0.0 : std::sqrt(d);
    inverse_square_root[i] = is_free ? 0.0 : 1.0 / square_root[i];
  }

  Eigen::Map<Eigen::Matrix<double, kRows, kParameters>> compressed(jacobian, size + 1, size);
  Matrix lower = factors.matrixL();
  lower = factors.transpositionsP().transpose() * lower;
  compressed.topRows(size) = square_root.asDiagonal() * lower.transpose();
  compressed.row(size).setZero();

  Vector head = factors.transpositionsP() * equations.gradient;
  factors.matrixL().solveInPlace(head);
  head.array() *= inverse_square_root.array();
  Eigen::Map<Eigen::Matrix<double, kRows, 1>> compressed_residuals(residuals, size + 1);
  compressed_residuals.head(size) = head;
  compressed_residuals[size] =
      std::sqrt(std::max(0.0, equations.squared_norm - head.squaredNorm()));
}

}  // namespace lift_slam
