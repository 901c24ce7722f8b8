#include "lift_slam/simulation/rendering/scene_for_test.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;

SceneVertex Vertex(const Vector3d& position, const Vector3d& normal, float u, float v) {
  return {position.cast<float>(), normal.normalized().cast<float>(), Vector2f(u, v),
          Vector2f(u, v)};
}

// A checker whose squares vary in brightness: corners for features, grain for filters.
SceneTexture NoisyChecker(const Color& even, const Color& odd, Random& random) {
  SceneTexture texture = CheckerTexture(even, odd, 8, 8, 16);
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const double grain = random.Uniform(0.6, 1.0);
    for (std::size_t c = 0; c < 3; ++c) {
      texture.rgba[i + c] = static_cast<std::uint8_t>(grain * texture.rgba[i + c]);
    }
  }
  return texture;
}

// Leaves: opaque discs on nothing.
SceneTexture TreeTexture(Random& random) {
  SceneTexture texture = CheckerTexture({20, 90, 20, 0}, {40, 120, 30, 0}, 16, 16, 8);
  texture.has_alpha = true;
  for (int leaf = 0; leaf < 150; ++leaf) {
    const double x = random.Uniform(8.0, 120.0), y = random.Uniform(8.0, 120.0);
    for (int row = 0; row < texture.height; ++row) {
      for (int column = 0; column < texture.width; ++column) {
        if (std::hypot(column - x, row - y) > 5.0) continue;
        texture.rgba[4 * static_cast<std::size_t>(row * texture.width + column) + 3] = 255;
      }
    }
  }
  return texture;
}

// Ground in squares of 4 m, one repeat of the picture each.
void AddGround(int length_m, Scene& scene) {
  for (int x = -40; x < length_m + 40; x += 4) {
    for (int y = -60; y < 60; y += 4) {
      scene.meshes.push_back(Card({static_cast<double>(x), static_cast<double>(y), 0.0},
                                  4.0 * Vector3d::UnitX(), 4.0 * Vector3d::UnitY(), 0, 0.2F));
    }
  }
}

// Front and side walls of a house in `pieces` x `pieces` rectangles.
void AddHouse(double x, double side, int texture, Scene& scene) {
  constexpr int kPieces = 4;
  const double step = 10.0 / kPieces;
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; j < kPieces; ++j) {
      const Vector3d up = 2.0 * Vector3d::UnitZ();
      const Vector3d front(x + i * step, side * 10.0, j * 2.0);
      scene.meshes.push_back(Card(front, step * Vector3d::UnitX(), up, texture, 0.2F));
      const Vector3d gable(x, side * (10.0 + i * step), j * 2.0);
      scene.meshes.push_back(Card(gable, side * step * Vector3d::UnitY(), up, texture, 0.2F));
    }
  }
}

}  // namespace

Scene DarkScene() {
  Scene scene;
  scene.name = "dark";
  scene.sky.color.setZero();
  scene.sky.color_below.setZero();
  scene.light.ambient.setZero();
  scene.light.diffuse.setZero();
  return scene;
}

SceneTexture CheckerTexture(const Color& even, const Color& odd, int columns, int rows,
                            int side_px) {
  SceneTexture texture{"checker", columns * side_px, rows * side_px, false, {}};
  texture.has_alpha = even[3] < 255 || odd[3] < 255;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const Color& color = (x / side_px + y / side_px) % 2 == 0 ? even : odd;
      texture.rgba.insert(texture.rgba.end(), color.begin(), color.end());
    }
  }
  return texture;
}

SceneMesh Card(const Vector3d& corner, const Vector3d& right, const Vector3d& up, int texture,
               float emission) {
  SceneMesh mesh;
  mesh.name = "card";
  mesh.texture = texture;
  mesh.emission.setConstant(emission);
  const Vector3d normal = right.cross(up);
  mesh.vertices = {Vertex(corner, normal, 0, 0), Vertex(corner + right, normal, 1, 0),
                   Vertex(corner + right + up, normal, 1, 1), Vertex(corner + up, normal, 0, 1)};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

SceneMesh Disc(const Vector3d& center, const Vector3d& normal, double radius) {
  constexpr std::uint32_t kCorners = 60;
  const Vector3d right = radius * normal.unitOrthogonal();
  const Vector3d up = normal.normalized().cross(right);
  SceneMesh mesh;
  mesh.name = "disc";
  mesh.emission.setOnes();
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    mesh.vertices.push_back(
        Vertex(center + std::cos(angle) * right + std::sin(angle) * up, normal, 0, 0));
    if (i >= 2) mesh.indices.insert(mesh.indices.end(), {0, i - 1, i});
  }
  return mesh;
}

Scene Street(int houses, std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.name = "street";
  scene.textures.push_back(NoisyChecker({120, 120, 110, 255}, {90, 90, 100, 255}, random));
  for (int i = 0; i < 8; ++i) {
    const auto shade = [&] { return static_cast<std::uint8_t>(random.UniformInt(60, 230)); };
    const Color even(shade(), shade(), shade(), 255);
    scene.textures.push_back(NoisyChecker(even, {200, 190, 170, 255}, random));
  }
  scene.textures.push_back(TreeTexture(random));
  AddGround(20 * houses, scene);
  for (int i = 0; i < 2 * houses; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double x = 20.0 * (i / 2);
    AddHouse(x, side, 1 + i % 8, scene);
    const Vector3d trunk(x + random.Uniform(11.0, 17.0), side * random.Uniform(6.0, 12.0), 0.0);
    scene.meshes.push_back(
        Card(trunk, -2.5 * side * Vector3d::UnitY(), 6.0 * Vector3d::UnitZ(), 9));
    scene.meshes.push_back(Card(trunk, 2.5 * Vector3d::UnitX(), 6.0 * Vector3d::UnitZ(), 9));
  }
  return scene;
}

Rigid3d LookingAlongX(const Vector3d& center) {
  Eigen::Matrix3d cam_from_scene;
  cam_from_scene << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return {cam_from_scene, Vector3d(-cam_from_scene * center)};
}

Camera TestCamera(int width, int height) {
  Camera camera;
  const double focal = 0.585 * width;
  camera.pinhole = {focal, 1.02 * focal, 0.49 * width, 0.52 * height, width, height};
  return camera;
}

}  // namespace lift_slam
