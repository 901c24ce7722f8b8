#include "lift_slam/simulation/scene/scene_loader.h"

#include <fmt/format.h>

#include "lift_slam/simulation/scene/ac3d_scene.h"
#include "lift_slam/simulation/scene/assimp_reader.h"
#include "lift_slam/simulation/scene/torcs_data.h"
#include "lift_slam/simulation/scene/torcs_sky.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace fs = std::filesystem;
namespace {

bool IsAc3d(const fs::path& file) {
  return file.extension() == ".ac" || file.extension() == ".acc";
}

// The folder's own description is there: NAME/NAME.xml.
bool IsTrackFolder(const fs::path& folder) {
  const std::string name = fs::weakly_canonical(folder).filename().string();
  return fs::is_regular_file(folder / (name + ".xml"));
}

void CheckContent(const Scene& scene, const fs::path& file) {
  if (scene.meshes.empty()) throw InputError(fmt::format("{}: no surface in it", file.string()));
  const bool has_texture = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                       [](const SceneMesh& mesh) { return mesh.texture >= 0; });
  if (!has_texture) {
    throw InputError(
        fmt::format("{}: a mesh without textures (none named, or none of their files found); "
                    "nothing could be tracked in its pictures",
                    file.string()));
  }
}

void LoadAc3d(const fs::path& file, std::vector<fs::path> texture_folders, LoadedScene& loaded) {
  TextureSet textures(std::move(texture_folders), &loaded.scene);
  AppendAc3d(ReadAc3d(file), textures, loaded.scene);
  CheckContent(loaded.scene, file);
  loaded.warnings = MissingTextureWarnings(textures);
}

// TORCS/tracks/CATEGORY/NAME -> TORCS/data/textures.
fs::path SharedTextures(const fs::path& track_folder) {
  const fs::path absolute = fs::weakly_canonical(track_folder);
  return absolute.parent_path().parent_path().parent_path() / "data" / "textures";
}

LoadedScene LoadTrack(const fs::path& folder) {
  LoadedScene loaded;
  loaded.track = ReadTorcsTrack(folder);
  loaded.scene.name = loaded.track->name;
  LoadAc3d(loaded.track->mesh, {folder, SharedTextures(folder)}, loaded);
  AddTorcsSky(*loaded.track, loaded.scene);
  return loaded;
}

LoadedScene LoadFile(const fs::path& file, const SceneLoaderOptions& options) {
  LoadedScene loaded;
  loaded.scene.name = file.stem().string();
  if (IsAc3d(file)) {
    LoadAc3d(file, {fs::absolute(file).parent_path()}, loaded);
    return loaded;
  }
  TextureSet textures({fs::absolute(file).parent_path()}, &loaded.scene);
  AppendWithAssimp(file, options.up_axis == UpAxis::kY, textures, loaded.scene);
  CheckContent(loaded.scene, file);
  loaded.warnings = MissingTextureWarnings(textures);
  return loaded;
}

}  // namespace

LoadedScene LoadScene(const std::string& track_or_file, const SceneLoaderOptions& options) {
  const fs::path path(track_or_file);
  std::error_code ignored;
  if (fs::is_directory(path, ignored) && IsTrackFolder(path)) return LoadTrack(path);
  if (fs::is_regular_file(path, ignored)) {
    const fs::path folder = fs::absolute(path).parent_path();
    const bool is_track_mesh = IsAc3d(path) && IsTrackFolder(folder) &&
                               ReadTorcsTrack(folder).mesh.filename() == path.filename();
    return is_track_mesh ? LoadTrack(folder) : LoadFile(path, options);
  }
  if (path.has_extension() || path.is_absolute() || track_or_file.starts_with(".")) {
    throw InputError(fmt::format("{}: no such scene file or track folder", track_or_file));
  }
  return LoadTrack(FindTorcsTrack(track_or_file, TorcsFolder(options.torcs_folder)));
}

}  // namespace lift_slam
