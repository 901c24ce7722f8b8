#pragma once

#include <Eigen/Core>
#include <vector>

namespace lift_slam {

// A closed uniform cubic B-spline: twice continuously differentiable, also at its seam. It comes
// near to its control points, without passing through them.
class PeriodicSpline {
 public:
  // Control point i sits at i * spacing; at least 4 of them. The period is size * spacing.
  PeriodicSpline(std::vector<Eigen::Vector3d> control_points, double spacing);

  double Period() const { return spacing_ * static_cast<double>(control_points_.size()); }
  Eigen::Vector3d Value(double x) const;
  Eigen::Vector3d Derivative(double x) const;
  Eigen::Vector3d SecondDerivative(double x) const;

 private:
  // The sum of the four control points around x with weights that depend on where between the
  // middle two x lies, as a share in [0, 1).
  Eigen::Vector3d Blend(double x, Eigen::Vector4d (*weights)(double share)) const;

  std::vector<Eigen::Vector3d> control_points_;
  double spacing_;
};

// Weights of a normal distribution, cut at 3 standard deviations, of sum 1: element i belongs to
// the offset i - radius, where radius = (size - 1) / 2. At least three.
std::vector<double> GaussianKernel(double standard_deviation, double spacing);

// Every value replaced by the weighted mean of its neighbours around the loop.
template <class Value>
std::vector<Value> SmoothAroundLoop(const std::vector<Value>& values,
                                    const std::vector<double>& kernel) {
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  const auto radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
  std::vector<Value> smooth;
  smooth.reserve(values.size());
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    Value sum = values[static_cast<std::size_t>(i)] * 0.0;
    for (std::ptrdiff_t offset = -radius; offset <= radius; ++offset) {
      const std::ptrdiff_t at = ((i + offset) % size + size) % size;
      sum +=
          values[static_cast<std::size_t>(at)] * kernel[static_cast<std::size_t>(offset + radius)];
    }
    smooth.push_back(sum);
  }
  return smooth;
}

}  // namespace lift_slam
