#include "lift_slam/simulation/scene/texture_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/simulation/scene/texture_file.h"

namespace lift_slam {
namespace {

// The file of that name in the folder: as written, or its last part alone (mesh files often keep
// the path of the machine they were made on). Empty when there is none.
std::filesystem::path FindFile(const std::filesystem::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path written(name);
  for (const std::filesystem::path& candidate : {folder / written, folder / written.filename()}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
  }
  return {};
}

}  // namespace

TextureSet::TextureSet(std::vector<std::filesystem::path> folders, Scene* scene)
    : folders_(std::move(folders)), scene_(scene) {}

int TextureSet::Find(const std::string& name) {
  if (const auto known = index_by_name_.find(name); known != index_by_name_.end()) {
    return known->second;
  }
  for (const std::filesystem::path& folder : folders_) {
    const std::filesystem::path file = FindFile(folder, name);
    if (!file.empty()) return Add(name, ReadTextureFile(file));
  }
  missing_.push_back(name);
  return index_by_name_[name] = -1;
}

int TextureSet::Add(const std::string& name, SceneTexture texture) {
  scene_->textures.push_back(std::move(texture));
  return index_by_name_[name] = static_cast<int>(scene_->textures.size()) - 1;
}

std::vector<std::string> MissingTextureWarnings(const TextureSet& textures) {
  const std::vector<std::string>& missing = textures.Missing();
  if (missing.empty()) return {};
  return {fmt::format("{} texture{} not found, drawn by colour alone: {}", missing.size(),
                      missing.size() == 1 ? "" : "s", fmt::join(missing, ", "))};
}

}  // namespace lift_slam
