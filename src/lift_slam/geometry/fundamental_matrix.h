#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace lift_slam {

// The fundamental matrix F (Frobenius norm 1) with x2^T F x1 = 0 that most matches fulfil within
// `max_error_px`, in pixels; the same for the same matches. By OpenCV's USAC. Nothing for fewer
// than eight matches or when no model is found. CheckError unless both have the same length.
std::optional<Eigen::Matrix3d> FindFundamentalMatrix(std::span<const Eigen::Vector2d> in_image1,
                                                     std::span<const Eigen::Vector2d> in_image2,
                                                     double max_error_px);

}  // namespace lift_slam
