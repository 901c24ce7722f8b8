#include "lift_slam/simulation/motion/road_path.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kSpacingM = 1.0;
constexpr double kMinLengthM = 20.0;

// Values along a closed way: points, and further numbers that go with them.
struct Loop {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> shapes;
};

void CheckRoad(const Road& road) {
  if (road.sections.size() < 4) {
    throw InputError(fmt::format("the road has {} cross-sections, expected a loop of at least 4",
                                 road.sections.size()));
  }
  for (std::size_t i = 0; i < road.sections.size(); ++i) {
    if (road.sections[i].left.allFinite() && road.sections[i].right.allFinite()) continue;
    throw InputError(fmt::format("the road's cross-section {} is not finite", i));
  }
}

Loop LoopOf(const Road& road) {
  Loop loop;
  for (const RoadSection& section : road.sections) {
    const Eigen::Vector3d across = section.left - section.right;
    const double banking = std::atan2(across.z(), across.head<2>().norm());
    loop.points.push_back(section.Center());
    loop.shapes.emplace_back(0.5 * across.norm(), banking, 0.0);
  }
  return loop;
}

// Lengths of the way from the first point to each, and back to the first at the end.
std::vector<double> CumulativeLengths(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> lengths = {0.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& next = points[(i + 1) % points.size()];
    lengths.push_back(lengths.back() + (next - points[i]).norm());
  }
  return lengths;
}

// The loop at equal steps of about kSpacingM along the way, straight between its points.
Loop Resample(const Loop& loop) {
  const std::vector<double> lengths = CumulativeLengths(loop.points);
  const auto count = static_cast<std::size_t>(std::max(8.0, std::round(lengths.back())));
  Loop even;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double length = lengths.back() * static_cast<double>(i) / static_cast<double>(count);
    while (lengths[at + 1] <= length) ++at;
    const double share = (length - lengths[at]) / (lengths[at + 1] - lengths[at]);
    const std::size_t next = (at + 1) % loop.points.size();
    even.points.push_back((1.0 - share) * loop.points[at] + share * loop.points[next]);
    even.shapes.push_back((1.0 - share) * loop.shapes[at] + share * loop.shapes[next]);
  }
  return even;
}

double Spacing(const Loop& loop) {
  return CumulativeLengths(loop.points).back() / static_cast<double>(loop.points.size());
}

// The loop's spline, so finely sampled that chords are as long as arcs.
Loop Refine(const Loop& loop) {
  constexpr int kSamples = 8;
  const PeriodicSpline points(loop.points, 1.0), shapes(loop.shapes, 1.0);
  Loop fine;
  for (std::size_t i = 0; i < loop.points.size() * kSamples; ++i) {
    fine.points.push_back(points.Value(static_cast<double>(i) / kSamples));
    fine.shapes.push_back(shapes.Value(static_cast<double>(i) / kSamples));
  }
  return fine;
}

Loop Smooth(const Loop& loop, double smoothing_m) {
  const std::vector<double> kernel = GaussianKernel(smoothing_m, kSpacingM);
  return {SmoothAroundLoop(loop.points, kernel), SmoothAroundLoop(loop.shapes, kernel)};
}

}  // namespace

RoadPath::RoadPath(const Road& road, double smoothing_m) {
  CheckRoad(road);
  const Loop raw = LoopOf(road);
  const double raw_length = CumulativeLengths(raw.points).back();
  if (raw_length < kMinLengthM) {
    throw InputError(fmt::format("the road is {:.1f} m long, expected a loop of at least {} m",
                                 raw_length, kMinLengthM));
  }
  Loop loop = Smooth(Resample(raw), smoothing_m);
  // Equal steps of the spline's parameter become equal lengths of the way.
  for (int i = 0; i < 2; ++i) loop = Resample(Refine(loop));
  const double spacing = Spacing(loop);
  min_half_width_m_ = loop.shapes.front().x();
  for (const Eigen::Vector3d& shape : loop.shapes) {
    min_half_width_m_ = std::min(min_half_width_m_, shape.x());
  }
  center_.emplace(std::move(loop.points), spacing);
  shape_.emplace(std::move(loop.shapes), spacing);
}

RoadPlace RoadPath::At(double distance_m) const {
  const Eigen::Vector3d velocity = center_->Derivative(distance_m);
  const Eigen::Vector3d acceleration = center_->SecondDerivative(distance_m);
  const Eigen::Vector3d shape = shape_->Value(distance_m);
  const Eigen::Vector3d level_left = Eigen::Vector3d(-velocity.y(), velocity.x(), 0.0).normalized();
  RoadPlace place;
  place.center = center_->Value(distance_m);
  place.forward = velocity.normalized();
  const Eigen::Vector3d banked =
      std::cos(shape.y()) * level_left + std::sin(shape.y()) * Eigen::Vector3d::UnitZ();
  place.left = (banked - banked.dot(place.forward) * place.forward).normalized();
  place.up = place.forward.cross(place.left);
  place.half_width_m = shape.x();
  const double cross = velocity.x() * acceleration.y() - velocity.y() * acceleration.x();
  place.curvature_per_m = cross / std::pow(velocity.head<2>().norm(), 3.0);
  return place;
}

Road Reversed(const Road& road) {
  Road reversed;
  for (std::size_t i = 0; i < road.sections.size(); ++i) {
    const RoadSection& section = road.sections[(road.sections.size() - i) % road.sections.size()];
    reversed.sections.push_back({section.right, section.left});
  }
  return reversed;
}

}  // namespace lift_slam
