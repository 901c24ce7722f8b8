#pragma once

#include <Eigen/Core>
#include <optional>

#include "lift_slam/camera/camera.h"

namespace lift_slam {

// Distortion and its inverse on normalised image coordinates (x / z, y / z).

// Where an ideal point is seen; nothing outside the model's valid range: beyond the radius where
// its polynomial stops rising, several ideal points would be seen at one place.
std::optional<Eigen::Vector2d> Distort(const Distortion& distortion, const Eigen::Vector2d& ideal);

// The largest radius of an ideal point, and for KannalaBrandt the largest angle from the optical
// axis (radians), at which the distortion is valid.
double ValidLimit(const Distortion& distortion);

// The inverse of Distort, to about 1e-14; nothing for a point that no valid ideal point maps to.
// `limit` is ValidLimit(distortion), which is slow to find and therefore handed in.
std::optional<Eigen::Vector2d> RemoveDistortion(const Distortion& distortion, double limit,
                                                const Eigen::Vector2d& distorted);

}  // namespace lift_slam
