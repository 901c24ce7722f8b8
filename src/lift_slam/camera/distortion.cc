#include "lift_slam/camera/distortion.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "lift_slam/camera/polynomial.h"

namespace lift_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kHalfPi = std::numbers::pi / 2.0;
// Of models valid everywhere: 89.9 degrees off the optical axis.
constexpr double kLargestRadius = 573.0;
// Below this omega the field-of-view model is the identity to machine precision.
constexpr double kSmallestOmega = 1e-8;

// The x in [0, high] with value(x) = target, for a rising function with value(0) = 0: Newton's
// method, kept within a bracket that shrinks. Nothing when value(high) < target.
template <class Value, class Slope>
std::optional<double> SolveRising(Value value, Slope slope, double target, double high) {
  if (!(value(high) >= target)) return std::nullopt;
  double low = 0.0, x = std::min(target, high);
  for (int i = 0; i < 100; ++i) {
    const double error = value(x) - target;
    (error > 0.0 ? high : low) = x;
    double next = x - error / slope(x);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-15 * x) return next;
    x = next;
  }
  return x;
}

// --- Radial-tangential. s = r^2; d(r radial(s)) / dr = 1 + 3 k1 s + 5 k2 s^2 + 7 k3 s^3.

std::array<double, 4> Radial(const RadialTangential& m) { return {1.0, m.k1, m.k2, m.k3}; }
std::array<double, 4> RadialSlope(const RadialTangential& m) {
  return {1.0, 3.0 * m.k1, 5.0 * m.k2, 7.0 * m.k3};
}

Vector2d Apply(const RadialTangential& m, const Vector2d& p) {
  const double x = p.x(), y = p.y(), s = p.squaredNorm();
  const double radial = EvaluatePolynomial(Radial(m), s);
  return {x * radial + 2.0 * m.p1 * x * y + m.p2 * (s + 2.0 * x * x),
          y * radial + m.p1 * (s + 2.0 * y * y) + 2.0 * m.p2 * x * y};
}

Matrix2d Jacobian(const RadialTangential& m, const Vector2d& p) {
  const double x = p.x(), y = p.y(), s = p.squaredNorm();
  const double radial = EvaluatePolynomial(Radial(m), s);
  const double d_radial = m.k1 + s * (2.0 * m.k2 + s * 3.0 * m.k3);  // by s
  const double xy = 2.0 * x * y * d_radial + 2.0 * m.p1 * x + 2.0 * m.p2 * y;
  Matrix2d jacobian;
  jacobian << radial + 2.0 * x * x * d_radial + 2.0 * m.p1 * y + 6.0 * m.p2 * x, xy, xy,
      radial + 2.0 * y * y * d_radial + 6.0 * m.p1 * y + 2.0 * m.p2 * x;
  return jacobian;
}

// --- Kannala-Brandt. s = theta^2; theta_d = theta (1 + k1 s + k2 s^2 + k3 s^3 + k4 s^4).

std::array<double, 5> Angular(const KannalaBrandt& m) { return {1.0, m.k1, m.k2, m.k3, m.k4}; }
std::array<double, 5> AngularSlope(const KannalaBrandt& m) {
  return {1.0, 3.0 * m.k1, 5.0 * m.k2, 7.0 * m.k3, 9.0 * m.k4};
}

struct Distorter {
  const Vector2d& ideal;

  std::optional<Vector2d> operator()(const NoDistortion&) const { return ideal; }

  std::optional<Vector2d> operator()(const RadialTangential& m) const {
    if (!IsPositiveUpTo(RadialSlope(m), ideal.squaredNorm())) return std::nullopt;
    if (Jacobian(m, ideal).determinant() <= 0.0) return std::nullopt;
    return Apply(m, ideal);
  }

  std::optional<Vector2d> operator()(const KannalaBrandt& m) const {
    const double radius = ideal.norm(), theta = std::atan(radius), s = theta * theta;
    if (!IsPositiveUpTo(AngularSlope(m), s)) return std::nullopt;
    if (radius < 1e-12) return ideal;
    return ideal * (theta * EvaluatePolynomial(Angular(m), s) / radius);
  }

  // r_d = atan(2 r tan(omega / 2)) / omega
  std::optional<Vector2d> operator()(const FieldOfView& m) const {
    const double radius = ideal.norm();
    if (m.omega < kSmallestOmega || radius < 1e-12) return ideal * CentralScale(m);
    const double distorted = std::atan(2.0 * radius * std::tan(0.5 * m.omega)) / m.omega;
    return ideal * (distorted / radius);
  }

  // r_d / r at the centre.
  static double CentralScale(const FieldOfView& m) {
    return m.omega < kSmallestOmega ? 1.0 : 2.0 * std::tan(0.5 * m.omega) / m.omega;
  }
};

struct LimitFinder {
  double operator()(const NoDistortion&) const { return kLargestRadius; }
  double operator()(const RadialTangential& m) const {
    return std::sqrt(FirstPositiveRoot(RadialSlope(m), kLargestRadius * kLargestRadius));
  }
  double operator()(const KannalaBrandt& m) const {
    const double largest = std::atan(kLargestRadius);
    return std::sqrt(FirstPositiveRoot(AngularSlope(m), largest * largest));
  }
  double operator()(const FieldOfView&) const { return kLargestRadius; }
};

struct Undistorter {
  const Vector2d& distorted;
  double limit;

  std::optional<Vector2d> operator()(const NoDistortion&) const { return distorted; }

  std::optional<Vector2d> operator()(const RadialTangential& m) const {
    const double target = distorted.norm();
    if (target < 1e-12) return distorted;
    const auto radius = SolveRising(
        [&](double r) { return r * EvaluatePolynomial(Radial(m), r * r); },
        [&](double r) { return EvaluatePolynomial(RadialSlope(m), r * r); }, target, limit);
    if (m.p1 == 0.0 && m.p2 == 0.0) {
      return radius ? std::optional<Vector2d>(distorted * (*radius / target)) : std::nullopt;
    }
    return AddTangential(m, distorted * (radius.value_or(limit) / target));
  }

  std::optional<Vector2d> operator()(const KannalaBrandt& m) const {
    const double target = distorted.norm();
    if (target < 1e-12) return distorted;
    const auto theta = SolveRising(
        [&](double t) { return t * EvaluatePolynomial(Angular(m), t * t); },
        [&](double t) { return EvaluatePolynomial(AngularSlope(m), t * t); }, target, limit);
    if (!theta || *theta >= kHalfPi) return std::nullopt;
    return distorted * (std::tan(*theta) / target);
  }

  std::optional<Vector2d> operator()(const FieldOfView& m) const {
    const double radius = distorted.norm();
    if (m.omega < kSmallestOmega || radius < 1e-12) return distorted / Distorter::CentralScale(m);
    if (radius * m.omega >= std::atan(kLargestRadius)) return std::nullopt;
    return distorted * (std::tan(radius * m.omega) / (2.0 * std::tan(0.5 * m.omega) * radius));
  }

 private:
  // Newton's method in two dimensions from the solution without tangential terms.
  std::optional<Vector2d> AddTangential(const RadialTangential& m, Vector2d ideal) const {
    for (int i = 0; i < 50; ++i) {
      const Matrix2d jacobian = Jacobian(m, ideal);
      if (!(jacobian.determinant() > 0.0)) return std::nullopt;
      const Vector2d step = jacobian.inverse() * (distorted - Apply(m, ideal));
      ideal += step;
      if (step.norm() <= 1e-15 * (1.0 + ideal.norm())) break;
    }
    const bool is_solution =
        (Apply(m, ideal) - distorted).norm() < 1e-12 * (1.0 + distorted.norm());
    if (!is_solution || ideal.norm() > limit) return std::nullopt;
    return ideal;
  }
};

}  // namespace

std::optional<Vector2d> Distort(const Distortion& distortion, const Vector2d& ideal) {
  if (!ideal.allFinite()) return std::nullopt;
  const std::optional<Vector2d> distorted = std::visit(Distorter{ideal}, distortion);
  if (distorted && !distorted->allFinite()) return std::nullopt;
  return distorted;
}

double ValidLimit(const Distortion& distortion) { return std::visit(LimitFinder{}, distortion); }

std::optional<Vector2d> RemoveDistortion(const Distortion& distortion, double limit,
                                         const Vector2d& distorted) {
  if (!distorted.allFinite()) return std::nullopt;
  return std::visit(Undistorter{distorted, limit}, distortion);
}

}  // namespace lift_slam
