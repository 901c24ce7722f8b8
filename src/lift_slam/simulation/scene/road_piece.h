#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// A rung of a road's ladder of quadrilaterals: two points, which of them is left unknown.
using RoadRung = std::array<Eigen::Vector3d, 2>;

// A piece of road: rungs in order along it, which end comes first unknown.
struct RoadPiece {
  int number = 0;               // order along the road as the mesh's name tells
  std::vector<RoadRung> rungs;  // at least 2

  const RoadRung& End(int end) const { return end == 0 ? rungs.front() : rungs.back(); }
};

// The ladders in a mesh, found from its triangles alone: each connected part whose outline can be
// paired across into rungs that are edges. Parts of another shape are left out. A single
// quadrilateral gives two pieces, one for each way across.
std::vector<RoadPiece> FindRoadPieces(const SceneMesh& mesh, int number);

}  // namespace lift_slam
