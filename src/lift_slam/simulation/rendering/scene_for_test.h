#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// Scenes made by rule, for tests and benchmarks. z up, metres.

using Color = Eigen::Matrix<std::uint8_t, 4, 1>;

// Nothing but a black sky, and no light.
Scene DarkScene();

// A picture of columns x rows squares of side_px, colour by (column + row) % 2.
SceneTexture CheckerTexture(const Color& even, const Color& odd, int columns, int rows,
                            int side_px);

// The rectangle of corner, corner + right, corner + right + up, corner + up; its picture once on
// it. Normal right x up. Lights itself by `emission`.
SceneMesh Card(const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
               const Eigen::Vector3d& up, int texture, float emission = 1.0F);

// A white, shining disc with the given normal.
SceneMesh Disc(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double radius);

// A street of `houses` textured houses and as many alpha-tested trees each side, on chequered
// ground of many triangles, from a seed. Drive along x from 0 to 20 m x houses at y = 0.
Scene Street(int houses, std::uint64_t seed);

// A camera at `center` that looks along +x of the scene, its y axis down.
Rigid3d LookingAlongX(const Eigen::Vector3d& center);

// A pinhole of 81 degrees horizontal field and the principal point a little off the middle.
Camera TestCamera(int width, int height);

}  // namespace lift_slam
