#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// Textures by the names that a mesh file uses, each loaded once into Scene::textures.
class TextureSet {
 public:
  // Names are looked for in these folders, in order. `scene` must outlive this object.
  TextureSet(std::vector<std::filesystem::path> folders, Scene* scene);

  // Index in Scene::textures; -1 when there is no such file. Throws InputError when the file is no
  // picture.
  int Find(const std::string& name);

  // Puts in a picture that is no file (embedded in the mesh file) under a name of its own.
  int Add(const std::string& name, SceneTexture texture);

  // Names that no folder holds, in order of their first use.
  const std::vector<std::string>& Missing() const { return missing_; }

 private:
  std::vector<std::filesystem::path> folders_;
  Scene* scene_;
  std::map<std::string, int> index_by_name_;
  std::vector<std::string> missing_;
};

// What a loader tells its user: one line that counts and names the missing textures, or none.
std::vector<std::string> MissingTextureWarnings(const TextureSet& textures);

}  // namespace lift_slam
