#include "lift_slam/simulation/rendering/scene_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Vector3f;

// A triangle with what it is sorted by.
struct SortedTriangle {
  int appearance;
  int cell_x, cell_y;
  std::array<std::uint32_t, 3> indices;  // in ChunkedScene::vertices

  auto Cell() const { return std::tuple(appearance, cell_x, cell_y); }
};

void CheckTexture(const Scene& scene, const SceneMesh& mesh, int texture) {
  if (texture >= -1 && texture < static_cast<int>(scene.textures.size())) return;
  throw InputError(fmt::format("mesh '{}' names texture {}, expected -1 to {}", mesh.name, texture,
                               static_cast<int>(scene.textures.size()) - 1));
}

void CheckMesh(const Scene& scene, const SceneMesh& mesh) {
  CheckTexture(scene, mesh, mesh.texture);
  CheckTexture(scene, mesh, mesh.shade_texture);
  const bool in_range = std::all_of(mesh.indices.begin(), mesh.indices.end(),
                                    [&](std::uint32_t i) { return i < mesh.vertices.size(); });
  if (mesh.indices.size() % 3 != 0 || !in_range) {
    throw InputError(fmt::format("mesh '{}': expected three indices a triangle, each below {}",
                                 mesh.name, mesh.vertices.size()));
  }
  for (const SceneVertex& vertex : mesh.vertices) {
    if (vertex.position.allFinite() && vertex.normal.allFinite() && vertex.uv.allFinite()) continue;
    throw InputError(fmt::format("mesh '{}' has a vertex that is not finite", mesh.name));
  }
}

Appearance AppearanceOf(const Scene& scene, const SceneMesh& mesh) {
  const bool has_alpha =
      mesh.texture >= 0 && scene.textures[static_cast<std::size_t>(mesh.texture)].has_alpha;
  return {mesh.texture, mesh.shade_texture, has_alpha,   mesh.double_sided,
          mesh.color,   mesh.emission,      mesh.ambient};
}

int FindOrAdd(const Appearance& appearance, std::vector<Appearance>& appearances) {
  const auto found = std::find(appearances.begin(), appearances.end(), appearance);
  if (found != appearances.end()) return static_cast<int>(found - appearances.begin());
  appearances.push_back(appearance);
  return static_cast<int>(appearances.size()) - 1;
}

DrawVertex MakeVertex(const SceneVertex& vertex, const Vector3f& to_sun) {
  const Vector3f& p = vertex.position;
  const bool has_shade = vertex.shade_uv.allFinite();
  return {{p.x(), p.y(), p.z()},
          {vertex.uv.x(), 1.0F - vertex.uv.y()},
          {has_shade ? vertex.shade_uv.x() : 0.0F, has_shade ? 1.0F - vertex.shade_uv.y() : 0.0F},
          vertex.normal.dot(to_sun)};
}

class Chunker {
 public:
  Chunker(const Scene& scene, const Vector3f& to_sun, double cell_m)
      : scene_(scene), to_sun_(to_sun), cell_m_(static_cast<float>(cell_m)) {}

  ChunkedScene Make() {
    for (const SceneMesh& mesh : scene_.meshes) AddMesh(mesh);
    std::stable_sort(triangles_.begin(), triangles_.end(),
                     [](const auto& a, const auto& b) { return a.Cell() < b.Cell(); });
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (i == 0 || triangles_[i].Cell() != triangles_[i - 1].Cell()) BeginChunk(triangles_[i]);
      AddToChunk(triangles_[i]);
    }
    return std::move(result_);
  }

 private:
  void AddMesh(const SceneMesh& mesh) {
    CheckMesh(scene_, mesh);
    const auto offset = static_cast<std::uint32_t>(result_.vertices.size());
    const int appearance = FindOrAdd(AppearanceOf(scene_, mesh), result_.appearances);
    for (const SceneVertex& vertex : mesh.vertices) {
      result_.vertices.push_back(MakeVertex(vertex, to_sun_));
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      AddTriangle(mesh, {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}, appearance,
                  offset);
    }
  }

  void AddTriangle(const SceneMesh& mesh, std::array<std::uint32_t, 3> corner, int appearance,
                   std::uint32_t offset) {
    const SceneVertex& a = mesh.vertices[corner[0]];
    const SceneVertex& b = mesh.vertices[corner[1]];
    const SceneVertex& c = mesh.vertices[corner[2]];
    const Vector3f normal = (b.position - a.position).cross(c.position - a.position);
    if (!(normal.squaredNorm() > 0.0F)) return;
    const bool is_turned = normal.dot(a.normal + b.normal + c.normal) < 0.0F;
    if (mesh.double_sided && is_turned) std::swap(corner[1], corner[2]);
    const Vector3f center = (a.position + b.position + c.position) / 3.0F;
    triangles_.push_back({appearance,
                          static_cast<int>(std::floor(center.x() / cell_m_)),
                          static_cast<int>(std::floor(center.y() / cell_m_)),
                          {corner[0] + offset, corner[1] + offset, corner[2] + offset}});
  }

  void BeginChunk(const SortedTriangle& triangle) {
    result_.chunks.push_back({triangle.appearance, Eigen::AlignedBox3f(),
                              static_cast<std::uint32_t>(result_.indices.size()), 0});
  }

  void AddToChunk(const SortedTriangle& triangle) {
    Chunk& chunk = result_.chunks.back();
    for (const std::uint32_t index : triangle.indices) {
      chunk.box.extend(Eigen::Map<const Vector3f>(result_.vertices[index].position));
      result_.indices.push_back(index);
    }
    chunk.index_count += 3;
  }

  const Scene& scene_;
  const Vector3f to_sun_;
  const float cell_m_;
  ChunkedScene result_;
  std::vector<SortedTriangle> triangles_;
};

}  // namespace

ChunkedScene MakeChunks(const Scene& scene, const Vector3f& to_sun, double cell_m) {
  return Chunker(scene, to_sun, cell_m).Make();
}

}  // namespace lift_slam
