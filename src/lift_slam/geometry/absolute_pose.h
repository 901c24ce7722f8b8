#pragma once
#include <vector>
#include <optional>
#include "lift_slam/geometry/rigid3.h"
namespace lift_slam {
struct AbsolutePoseOptions { double focal_length_px=0; std::uint64_t seed=0; };
struct AbsolutePose { Rigid3d cam_from_world; };
inline std::optional<AbsolutePose> EstimateAbsolutePose(const std::vector<Eigen::Vector2d>&, const std::vector<Eigen::Vector3d>&, const AbsolutePoseOptions&) { return std::nullopt; }
}
