#pragma once

#include <span>

namespace lift_slam {

// c[0] + c[1] x + c[2] x^2 + ...
double EvaluatePolynomial(std::span<const double> coefficients, double x);

// True when the polynomial is positive on all of [0, x].
bool IsPositiveUpTo(std::span<const double> coefficients, double x);

// The smallest root in (0, limit]; `limit` when there is none. c[0] must be positive, and there
// may be at most 8 coefficients.
double FirstPositiveRoot(std::span<const double> coefficients, double limit);

}  // namespace lift_slam
