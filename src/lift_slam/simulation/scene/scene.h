#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace lift_slam {

// A picture to put on a surface: RGBA, 8 bits a channel, row 0 at the TOP.
struct SceneTexture {
  std::string name;  // file name, for messages
  int width = 0;
  int height = 0;
  bool has_alpha = false;  // some pixel's alpha is below 128: surfaces with it are alpha-tested
  std::vector<std::uint8_t> rgba;
};

// Texture coordinates: u to the right, v UP (v = 0 is the picture's bottom row), repeated outside
// [0, 1].
struct SceneVertex {
  Eigen::Vector3f position;  // scene frame, metres
  Eigen::Vector3f normal;    // unit length
  Eigen::Vector2f uv;        // of the base texture
  Eigen::Vector2f shade_uv;  // of the shade texture
};

// Triangles with one appearance.
struct SceneMesh {
  std::string name;
  int texture = -1;                                 // index in Scene::textures; -1: color alone
  int shade_texture = -1;                           // multiplied on top (baked shadows); -1: none
  Eigen::Vector3f color = Eigen::Vector3f::Ones();  // diffuse colour, 0 to 1
  Eigen::Vector3f emission = Eigen::Vector3f::Zero();  // light of its own, 0 to 1, textured too
  Eigen::Vector3f ambient = Eigen::Vector3f::Ones();   // share of the ambient light, 0 to 1
  bool double_sided = true;
  std::vector<SceneVertex> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle
};

// What is seen behind everything, infinitely far: a picture on a cylinder around the camera.
struct SceneSky {
  int texture = -1;                                   // index in Scene::textures; -1: `color` alone
  Eigen::Vector3f color = {0.6F, 0.7F, 0.85F};        // above the picture, or without one
  Eigen::Vector3f color_below = {0.35F, 0.4F, 0.3F};  // below the picture
  // The picture spans these elevations (radians above the horizon), on the cylinder: its height is
  // linear in the elevation's tangent. It goes `repeats` times around, u growing to the right (seen
  // from the middle) from 0 at the scene's x axis.
  double bottom_elevation_rad = -0.35;
  double top_elevation_rad = 0.6;
  double repeats = 1.0;
};

struct SceneLight {
  Eigen::Vector3f to_sun = {0.3F, 0.4F, 0.866F};  // unit length, scene frame
  Eigen::Vector3f ambient = {0.4F, 0.4F, 0.4F};
  Eigen::Vector3f diffuse = {0.8F, 0.8F, 0.8F};
};

// A static scene. Scene frame: z up, right-handed, metres.
struct Scene {
  std::string name;
  std::vector<SceneTexture> textures;
  std::vector<SceneMesh> meshes;
  SceneSky sky;
  SceneLight light;
};

}  // namespace lift_slam
