#include "lift_slam/camera/polynomial.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// The root in [low, high], where the polynomial is monotonic and changes sign.
double Bisect(std::span<const double> coefficients, double low, double high) {
  const bool low_is_positive = EvaluatePolynomial(coefficients, low) > 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    const bool is_positive = EvaluatePolynomial(coefficients, middle) > 0.0;
    (is_positive == low_is_positive ? low : high) = middle;
  }
  return low;
}

// All sign changes in [0, limit], ascending: between neighbouring extrema there is at most one.
std::vector<double> SignChanges(std::span<const double> coefficients, double limit) {
  if (coefficients.size() < 2) return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < coefficients.size(); ++i) {
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  }
  std::vector<double> ends = SignChanges(derivative, limit);
  ends.push_back(limit);
  std::vector<double> roots;
  double low = 0.0;
  for (const double high : ends) {
    const bool from = EvaluatePolynomial(coefficients, low) > 0.0;
    const bool to = EvaluatePolynomial(coefficients, high) > 0.0;
    if (from != to) roots.push_back(Bisect(coefficients, low, high));
    low = high;
  }
  return roots;
}

}  // namespace

double EvaluatePolynomial(std::span<const double> coefficients, double x) {
  double value = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
  return value;
}

bool IsPositiveUpTo(std::span<const double> coefficients, double x) {
  // Without its positive terms the polynomial falls, so that its value at x bounds all before.
  double lower_bound = coefficients[0], power = 1.0;
  for (std::size_t i = 1; i < coefficients.size(); ++i) {
    power *= x;
    lower_bound += std::min(0.0, coefficients[i]) * power;
  }
  if (lower_bound > 0.0) return true;
  return EvaluatePolynomial(coefficients, x) > 0.0 && FirstPositiveRoot(coefficients, x) >= x;
}

double FirstPositiveRoot(std::span<const double> coefficients, double limit) {
  LIFT_SLAM_CHECK(!coefficients.empty() && coefficients.size() <= 8 && coefficients[0] > 0.0,
                  "{} coefficients", coefficients.size());
  const std::vector<double> roots = SignChanges(coefficients, limit);
  return roots.empty() ? limit : roots.front();
}

}  // namespace lift_slam
