#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lift_slam/simulation/motion/periodic_spline.h"
#include "lift_slam/simulation/scene/road.h"

namespace lift_slam {

// A place on a road: an orthonormal frame that lies in the road's surface.
struct RoadPlace {
  Eigen::Vector3d center;   // of the road, scene frame
  Eigen::Vector3d forward;  // unit length, along the road's slope
  Eigen::Vector3d left;     // unit length, along the road's banking
  Eigen::Vector3d up;       // unit length, off the surface
  double half_width_m = 0.0;
  double curvature_per_m = 0.0;  // seen from above; positive: to the left
};

// The smooth centre line of a road, by the length of the way along it: twice continuously
// differentiable everywhere, also where the loop closes.
class RoadPath {
 public:
  // The centre line is averaged with a normal distribution of `smoothing_m` along the way, so that
  // a mesh's corners do not shake the car. Throws InputError for a road that is no loop to drive:
  // fewer than 4 sections, a length below 20 m, a number that is not finite.
  RoadPath(const Road& road, double smoothing_m);

  double LengthM() const { return center_->Period(); }
  // Any distance; they repeat around the loop.
  RoadPlace At(double distance_m) const;
  double MinHalfWidthM() const { return min_half_width_m_; }

 private:
  std::optional<PeriodicSpline> center_;
  std::optional<PeriodicSpline> shape_;  // half width, banking angle (left side up), nothing
  double min_half_width_m_ = 0.0;
};

// The same road driven the other way round, from the same start.
Road Reversed(const Road& road);

}  // namespace lift_slam
