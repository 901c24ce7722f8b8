#include "lift_slam/simulation/scene/road_piece.h"

#include <map>
#include <set>
#include <utility>

namespace lift_slam {
namespace {

using Edge = std::pair<int, int>;

Edge EdgeOf(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Triangles over points without duplicates.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

WeldedMesh Weld(const SceneMesh& mesh) {
  WeldedMesh welded;
  std::map<std::array<float, 3>, int> index_of;
  std::vector<int> welded_of;
  for (const SceneVertex& vertex : mesh.vertices) {
    const Eigen::Vector3f& p = vertex.position;
    const auto [entry, is_new] =
        index_of.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(welded.points.size()));
    if (is_new) welded.points.push_back(p.cast<double>());
    welded_of.push_back(entry->second);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = welded_of[mesh.indices[i + k]];
    welded.triangles.push_back(triangle);
  }
  return welded;
}

// For each edge, the number of triangles that have it.
std::map<Edge, int> CountEdges(const WeldedMesh& mesh) {
  std::map<Edge, int> count;
  for (const std::array<int, 3>& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++count[EdgeOf(t[k], t[(k + 1) % 3])];
  }
  return count;
}

// The closed outlines: boundary edges chained, each point having exactly two of them. Chains with
// another point are left out.
std::vector<std::vector<int>> Outlines(const std::map<Edge, int>& edges) {
  std::map<int, std::vector<int>> neighbors;
  for (const auto& [edge, count] : edges) {
    if (count != 1) continue;
    neighbors[edge.first].push_back(edge.second);
    neighbors[edge.second].push_back(edge.first);
  }
  std::vector<std::vector<int>> outlines;
  std::set<int> seen;
  for (const auto& [start, unused] : neighbors) {
    std::vector<int> outline;
    bool simple = true;
    for (int at = start; seen.insert(at).second;) {
      outline.push_back(at);
      const std::vector<int>& next = neighbors[at];
      simple = simple && next.size() == 2;
      at = seen.count(next.front()) == 0 ? next.front() : next.back();
    }
    if (simple && outline.size() >= 4) outlines.push_back(std::move(outline));
  }
  return outlines;
}

// The outline of n points paired i with shift - i (modulo n), starting so that the first pair is an
// end. Empty when some pair is no edge, or the pairs at the ends are not on the outline.
std::vector<Edge> PairAcross(const std::vector<int>& outline, std::size_t first,
                             const std::map<Edge, int>& edges) {
  const std::size_t size = outline.size();
  std::vector<Edge> pairs;
  for (std::size_t i = 0; i < size / 2; ++i) {
    const Edge pair = {outline[(first + i) % size], outline[(first + size - 1 - i) % size]};
    const auto edge = edges.find(EdgeOf(pair.first, pair.second));
    const bool is_end = i == 0 || i + 1 == size / 2;
    if (edge == edges.end() || edge->second != (is_end ? 1 : 2)) return {};
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

std::vector<RoadPiece> FindRoadPieces(const SceneMesh& mesh, int number) {
  const WeldedMesh welded = Weld(mesh);
  const std::map<Edge, int> edges = CountEdges(welded);
  std::vector<RoadPiece> pieces;
  for (const std::vector<int>& outline : Outlines(edges)) {
    if (outline.size() % 2 != 0) continue;
    for (std::size_t first = 0; first < outline.size() / 2; ++first) {
      RoadPiece piece;
      piece.number = number;
      for (const auto& [a, b] : PairAcross(outline, first, edges)) {
        piece.rungs.push_back({welded.points[static_cast<std::size_t>(a)],
                               welded.points[static_cast<std::size_t>(b)]});
      }
      if (!piece.rungs.empty()) pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace lift_slam
