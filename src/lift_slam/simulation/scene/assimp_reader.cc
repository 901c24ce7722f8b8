#include "lift_slam/simulation/scene/assimp_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "lift_slam/simulation/scene/texture_file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// PreTransformVertices applies the nodes' transforms and gives one list of meshes.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_PreTransformVertices |
                            aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                            aiProcess_FindDegenerates | aiProcess_JoinIdenticalVertices;

SceneTexture DecodeEmbedded(const aiTexture& embedded, const std::string& name,
                            const std::filesystem::path& file) {
  if (embedded.mHeight == 0) {  // a picture file's bytes, mWidth of them
    const auto* bytes = reinterpret_cast<const char*>(embedded.pcData);
    return DecodeTexture({bytes, embedded.mWidth}, file.string() + ":" + name);
  }
  SceneTexture texture;
  texture.name = name;
  texture.width = static_cast<int>(embedded.mWidth);
  texture.height = static_cast<int>(embedded.mHeight);
  for (std::size_t i = 0; i < std::size_t{embedded.mWidth} * embedded.mHeight; ++i) {
    const aiTexel& texel = embedded.pcData[i];
    texture.rgba.insert(texture.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
    if (texel.a < kAlphaCut) texture.has_alpha = true;
  }
  return texture;
}

class AssimpAppender {
 public:
  AssimpAppender(const std::filesystem::path& file, const aiScene& source, bool y_is_up,
                 TextureSet& textures, Scene& scene)
      : file_(file), source_(source), y_is_up_(y_is_up), textures_(textures), scene_(scene) {}

  void Append() {
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) AppendMesh(*source_.mMeshes[i]);
  }

 private:
  Eigen::Vector3f ToScene(const aiVector3D& v) const {
    return y_is_up_ ? Eigen::Vector3f(v.x, -v.z, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
  }

  int FindTexture(const aiMaterial& material) {
    aiString name;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) {
      return -1;
    }
    if (const aiTexture* embedded = source_.GetEmbeddedTexture(name.C_Str())) {
      const auto [entry, is_new] = embedded_.try_emplace(name.C_Str(), -1);
      if (is_new) {
        entry->second = textures_.Add(name.C_Str(), DecodeEmbedded(*embedded, name.C_Str(), file_));
      }
      return entry->second;
    }
    return textures_.Find(name.C_Str());
  }

  void SetAppearance(const aiMaterial& material, SceneMesh& mesh) {
    mesh.texture = FindTexture(material);
    aiColor4D color;
    if (material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
        material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
      mesh.color = {color.r, color.g, color.b};
    }
    mesh.ambient = mesh.color;
    if (material.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS) {
      mesh.emission = {color.r, color.g, color.b};
    }
    int two_sided = 1;
    if (material.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS) {
      mesh.double_sided = two_sided != 0;
    }
  }

  void AppendMesh(const aiMesh& source) {
    if ((source.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;
    SceneMesh mesh;
    mesh.name = source.mName.C_Str();
    SetAppearance(*source_.mMaterials[source.mMaterialIndex], mesh);
    for (unsigned i = 0; i < source.mNumVertices; ++i) mesh.vertices.push_back(Vertex(source, i));
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) continue;
      mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + 3);
    }
    if (!mesh.indices.empty()) scene_.meshes.push_back(std::move(mesh));
  }

  // assimp's v grows upwards, as the scene's does.
  SceneVertex Vertex(const aiMesh& source, unsigned i) const {
    SceneVertex vertex{ToScene(source.mVertices[i]), Eigen::Vector3f::UnitZ(),
                       Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()};
    if (source.HasNormals()) {
      const Eigen::Vector3f normal = ToScene(source.mNormals[i]).stableNormalized();
      if (normal.allFinite() && normal.squaredNorm() > 0.5F) vertex.normal = normal;
    }
    if (source.HasTextureCoords(0)) {
      vertex.uv = {source.mTextureCoords[0][i].x, source.mTextureCoords[0][i].y};
    }
    if (!vertex.position.allFinite() || !vertex.uv.allFinite()) {
      throw InputError(fmt::format("{}: mesh '{}': vertex {} is not finite", file_.string(),
                                   source.mName.C_Str(), i));
    }
    return vertex;
  }

  const std::filesystem::path& file_;
  const aiScene& source_;
  bool y_is_up_;
  TextureSet& textures_;
  Scene& scene_;
  std::map<std::string, int> embedded_;
};

}  // namespace

void AppendWithAssimp(const std::filesystem::path& file, bool y_is_up, TextureSet& textures,
                      Scene& scene) {
  Assimp::Importer importer;
  const aiScene* source = importer.ReadFile(file.string(), kSteps);
  if (source == nullptr || (source->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    throw InputError(
        fmt::format("{}: no scene that can be read: {}", file.string(), importer.GetErrorString()));
  }
  AssimpAppender(file, *source, y_is_up, textures, scene).Append();
}

}  // namespace lift_slam
