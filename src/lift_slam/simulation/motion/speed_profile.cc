#include "lift_slam/simulation/motion/speed_profile.h"

#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kSmoothingM = 4.0;
constexpr double kTimeStepS = 0.02;
// Control points of the spline that a value depends on, to either side.
constexpr int kSplineReach = 2;

// The least value within `reach` neighbours of each. After this, averaging over these neighbours
// cannot exceed what the limit was.
std::vector<double> LeastOfNeighbours(const std::vector<double>& values, std::ptrdiff_t reach) {
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> least = values;
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    for (std::ptrdiff_t offset = -reach; offset <= reach; ++offset) {
      const std::ptrdiff_t at = ((i + offset) % size + size) % size;
      double& value = least[static_cast<std::size_t>(i)];
      value = std::min(value, values[static_cast<std::size_t>(at)]);
    }
  }
  return least;
}

// v^2 may rise by 2 a ds along each step and fall likewise; twice around, as the limits reach
// across the seam.
void LimitSlope(std::vector<double>& squared, double max_rise, double max_fall) {
  const std::size_t size = squared.size();
  for (std::size_t i = 1; i < 2 * size; ++i) {
    squared[i % size] = std::min(squared[i % size], squared[(i - 1) % size] + max_rise);
  }
  for (std::size_t i = 2 * size - 1; i > 0; --i) {
    squared[(i - 1) % size] = std::min(squared[(i - 1) % size], squared[i % size] + max_fall);
  }
}

PeriodicSpline MakeSquaredSpeed(const std::function<double(double)>& curvature_per_m,
                                double length_m, const SpeedOptions& options) {
  const auto count = static_cast<std::size_t>(std::max(8.0, std::round(length_m)));
  const double spacing = length_m / static_cast<double>(count);
  const double top = options.top_m_s * options.top_m_s;
  std::vector<double> squared(count, top);
  if (!options.constant) {
    for (std::size_t i = 0; i < count; ++i) {
      const double curvature = std::abs(curvature_per_m(static_cast<double>(i) * spacing));
      squared[i] = std::min(top, options.max_lateral_m_s2 / std::max(curvature, 1e-9));
    }
    const std::vector<double> kernel = GaussianKernel(kSmoothingM, spacing);
    const auto reach = static_cast<std::ptrdiff_t>(kernel.size() / 2) + kSplineReach;
    squared = LeastOfNeighbours(squared, reach);
    LimitSlope(squared, 2.0 * options.max_acceleration_m_s2 * spacing,
               2.0 * options.max_deceleration_m_s2 * spacing);
    squared = SmoothAroundLoop(squared, kernel);
  }
  std::vector<Eigen::Vector3d> control_points;
  for (const double value : squared) control_points.emplace_back(value, 0.0, 0.0);
  return {std::move(control_points), spacing};
}

}  // namespace

SpeedProfile::SpeedProfile(const std::function<double(double)>& curvature_per_m, double length_m,
                           const SpeedOptions& options)
    : squared_speed_(MakeSquaredSpeed(curvature_per_m, length_m, options)) {}

double SpeedProfile::SpeedAt(double distance_m) const {
  return std::sqrt(squared_speed_.Value(distance_m).x());
}

// dv/dt = v dv/ds = d(v^2)/ds / 2.
double SpeedProfile::AccelerationAt(double distance_m) const {
  return 0.5 * squared_speed_.Derivative(distance_m).x();
}

DistanceOverTime::DistanceOverTime(const SpeedProfile& profile, double start_m, double length_m)
    : profile_(profile), start_m_(start_m), length_m_(length_m) {
  LIFT_SLAM_CHECK(length_m > 0.0, "length {}", length_m);
  distances_m_ = {0.0};
  const auto speed = [&](double distance) { return profile.SpeedAt(start_m + distance); };
  while (distances_m_.back() < length_m) {  // Runge-Kutta of fourth order for ds/dt = v(s)
    const double s = distances_m_.back();
    const double k1 = speed(s);
    const double k2 = speed(s + 0.5 * kTimeStepS * k1);
    const double k3 = speed(s + 0.5 * kTimeStepS * k2);
    const double k4 = speed(s + kTimeStepS * k3);
    distances_m_.push_back(s + kTimeStepS / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
  }
  const double before = distances_m_[distances_m_.size() - 2];
  const double share = (length_m - before) / (distances_m_.back() - before);
  duration_s_ = kTimeStepS * (static_cast<double>(distances_m_.size() - 2) + share);
}

// Cubic Hermite between two steps, from their distances and speeds.
double DistanceOverTime::DistanceM(double time_s) const {
  const double steps = std::clamp(time_s, 0.0, duration_s_) / kTimeStepS;
  const auto at = std::min(static_cast<std::size_t>(steps), distances_m_.size() - 2);
  const double t = steps - static_cast<double>(at);
  const double from = distances_m_[at], to = distances_m_[at + 1];
  const double from_step = kTimeStepS * profile_.SpeedAt(start_m_ + from);
  const double to_step = kTimeStepS * profile_.SpeedAt(start_m_ + to);
  const double value = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t) * from +
                       t * (1.0 - t) * (1.0 - t) * from_step + t * t * (3.0 - 2.0 * t) * to -
                       t * t * (1.0 - t) * to_step;
  return std::min(value, length_m_);
}

double DistanceOverTime::SpeedM_s(double time_s) const {
  return profile_.SpeedAt(start_m_ + DistanceM(time_s));
}

}  // namespace lift_slam
