#include "lift_slam/simulation/scene/ac3d_scene.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lift_slam/simulation/scene/polygon.h"

namespace lift_slam {
namespace {

// Triangle of one object: corner numbers within its surface.
struct Face {
  const Ac3dSurface* surface;
  std::array<int, 3> corners;
  Eigen::Vector3f normal;  // length: twice the area
};

const Ac3dCorner& CornerOf(const Face& face, std::size_t k) {
  return face.surface->corners[static_cast<std::size_t>(face.corners[k])];
}

const Eigen::Vector3f& PositionOf(const Ac3dObject& object, const Ac3dCorner& corner) {
  return object.vertices[static_cast<std::size_t>(corner.vertex)];
}

std::vector<std::array<int, 3>> Triangles(const Ac3dObject& object, const Ac3dSurface& surface) {
  const int size = static_cast<int>(surface.corners.size());
  std::vector<std::array<int, 3>> triangles;
  if (surface.is_strip) {
    // Every second triangle of a strip turns the other way.
    for (int i = 0; i + 2 < size; ++i) {
      triangles.push_back({i, i + 1 + i % 2, i + 2 - i % 2});
    }
    return triangles;
  }
  std::vector<Eigen::Vector3f> positions;
  for (const Ac3dCorner& corner : surface.corners) {
    positions.push_back(PositionOf(object, corner));
  }
  return TriangulatePolygon(positions);
}

// All triangles with an area.
std::vector<Face> Faces(const Ac3dObject& object) {
  std::vector<Face> faces;
  for (const Ac3dSurface& surface : object.surfaces) {
    for (const std::array<int, 3>& corners : Triangles(object, surface)) {
      Face face{&surface, corners, Eigen::Vector3f::Zero()};
      const Eigen::Vector3f a = PositionOf(object, CornerOf(face, 0));
      const Eigen::Vector3f b = PositionOf(object, CornerOf(face, 1));
      const Eigen::Vector3f c = PositionOf(object, CornerOf(face, 2));
      face.normal = (b - a).cross(c - a);
      if (face.normal.squaredNorm() > 0.0F) faces.push_back(face);
    }
  }
  return faces;
}

// Normals of corners: the file's, or the sum over the faces around the vertex (by area) that are
// not beyond the crease.
class Normals {
 public:
  Normals(const Ac3dObject& object, const std::vector<Face>& faces)
      : object_(object),
        min_cosine_(std::cos(object.crease_deg * std::numbers::pi_v<float> / 180.0F)) {
    if (!object.normals.empty()) return;
    faces_at_vertex_.resize(object.vertices.size());
    for (const Face& face : faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        faces_at_vertex_[static_cast<std::size_t>(CornerOf(face, k).vertex)].push_back(&face);
      }
    }
  }

  Eigen::Vector3f At(const Face& face, std::size_t k) const {
    const auto vertex = static_cast<std::size_t>(CornerOf(face, k).vertex);
    if (!object_.normals.empty()) return object_.normals[vertex];
    const Eigen::Vector3f own = face.normal.stableNormalized();
    if (!face.surface->smooth) return own;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const Face* other : faces_at_vertex_[vertex]) {
      if (own.dot(other->normal.stableNormalized()) >= min_cosine_) sum += other->normal;
    }
    return sum.stableNormalized();
  }

 private:
  const Ac3dObject& object_;
  float min_cosine_;
  std::vector<std::vector<const Face*>> faces_at_vertex_;
};

// A mesh in the making: equal vertices are stored once.
class MeshBuilder {
 public:
  explicit MeshBuilder(SceneMesh mesh) : mesh_(std::move(mesh)) {}

  void Add(const SceneVertex& vertex) {
    const auto [entry, is_new] =
        index_of_.try_emplace(Key(vertex), static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(vertex);
    mesh_.indices.push_back(entry->second);
  }

  SceneMesh Take() { return std::move(mesh_); }

 private:
  using VertexKey = std::array<float, 10>;
  static VertexKey Key(const SceneVertex& v) {
    return {v.position.x(), v.position.y(), v.position.z(), v.normal.x(),   v.normal.y(),
            v.normal.z(),   v.uv.x(),       v.uv.y(),       v.shade_uv.x(), v.shade_uv.y()};
  }

  SceneMesh mesh_;
  std::map<VertexKey, std::uint32_t> index_of_;
};

SceneMesh EmptyMesh(const Ac3dObject& object, const Ac3dMaterial& material, bool two_sided,
                    TextureSet& textures) {
  SceneMesh mesh;
  mesh.name = object.name;
  if (!object.texture.empty()) mesh.texture = textures.Find(object.texture);
  if (!object.shade_texture.empty()) mesh.shade_texture = textures.Find(object.shade_texture);
  mesh.color = material.color;
  mesh.ambient = material.color;  // as TORCS draws it, whatever the file's ambient colour
  mesh.emission = material.emission;
  mesh.double_sided = two_sided;
  return mesh;
}

void AppendObject(const Ac3dModel& model, const Ac3dObject& object, TextureSet& textures,
                  Scene& scene) {
  const std::vector<Face> faces = Faces(object);
  const Normals normals(object, faces);
  std::map<std::pair<int, bool>, std::size_t> builder_of;
  std::vector<MeshBuilder> builders;
  for (const Face& face : faces) {
    const Ac3dSurface& surface = *face.surface;
    const auto [entry, is_new] =
        builder_of.try_emplace({surface.material, surface.two_sided}, builders.size());
    if (is_new) {
      const auto material = static_cast<std::size_t>(surface.material);
      builders.emplace_back(
          EmptyMesh(object, model.materials.empty() ? Ac3dMaterial() : model.materials[material],
                    surface.two_sided, textures));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Ac3dCorner& corner = CornerOf(face, k);
      builders[entry->second].Add(
          {PositionOf(object, corner), normals.At(face, k), corner.uv, corner.shade_uv});
    }
  }
  for (MeshBuilder& builder : builders) scene.meshes.push_back(builder.Take());
}

}  // namespace

void AppendAc3d(const Ac3dModel& model, TextureSet& textures, Scene& scene) {
  for (const Ac3dObject& object : model.objects) AppendObject(model, object, textures, scene);
}

}  // namespace lift_slam
