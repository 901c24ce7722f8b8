#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lift_slam {

// AC3D text files (.ac) and the variant of the racing game TORCS (.acc), which adds vertex normals
// and up to four textures an object. Sources: "The AC3D file format", inivis; the tracks of
// Debian's torcs-data for the variant.

struct Ac3dMaterial {
  Eigen::Vector3f color = Eigen::Vector3f::Ones();  // diffuse
  Eigen::Vector3f ambient = Eigen::Vector3f::Ones();
  Eigen::Vector3f emission = Eigen::Vector3f::Zero();
  float transparency = 0.0F;  // 0: opaque, 1: not to be seen
};

struct Ac3dCorner {
  int vertex = 0;            // index in Ac3dObject::vertices
  Eigen::Vector2f uv;        // base texture; v = 0 is the picture's bottom
  Eigen::Vector2f shade_uv;  // TORCS: the shadow map ("tiled")
};

struct Ac3dSurface {
  bool is_strip = false;  // a triangle strip; else one polygon
  bool two_sided = false;
  bool smooth = false;
  int material = 0;
  std::vector<Ac3dCorner> corners;  // at least 3
};

struct Ac3dObject {
  std::string name;
  std::string texture;        // file name as written; empty: none
  std::string shade_texture;  // TORCS: the shadow map, multiplied on the base; empty: none
  float crease_deg = 61.0F;   // faces that meet at a sharper angle have an edge
  std::vector<Eigen::Vector3f> vertices;  // z up (x, -z, y of the file), all transforms applied
  std::vector<Eigen::Vector3f> normals;   // one a vertex, or none in plain AC3D files
  std::vector<Ac3dSurface> surfaces;      // lines are left out
};

struct Ac3dModel {
  std::vector<Ac3dMaterial> materials;
  std::vector<Ac3dObject> objects;  // in file order; groups are resolved
};

// Throws InputError with file and line when the text is no AC3D file or breaks off. An .acc file
// may end after any object: TORCS's own files do, their counts of children being too large.
Ac3dModel ReadAc3d(const std::filesystem::path& path);
Ac3dModel ParseAc3d(std::string_view text, const std::filesystem::path& path);

}  // namespace lift_slam
