#include "lift_slam/simulation/rendering/culling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/rendering/scene_for_test.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Vector3d;

SceneMesh SmallCard(const Vector3d& center, int texture = -1) {
  return Card(center, {0.0, -0.5, 0.0}, {0.0, 0.0, 0.5}, texture);
}

ChunkedScene Chunks(const Scene& scene) {
  return MakeChunks(scene, Eigen::Vector3f::UnitZ(), 64.0);
}

std::vector<int> Visible(const ChunkedScene& scene, const Vector3d& eye) {
  const PinholeView view{TestCamera(160, 96).pinhole};
  return VisibleChunks(scene, view, {LookingAlongX(eye).RotationMatrix(), eye}, {0.1, 1000.0});
}

TEST(Culling, KeepsWhatTheViewTouches) {
  const Vector3d eye(100.0, 50.0, 2.0);
  const std::vector<Vector3d> seen = {
      {5, 0, 0}, {100, 80, 0}, {100, -80, 0}, {990, 0, 0}, {10, 0, 4}};
  const std::vector<Vector3d> unseen = {
      {-5, 0, 0}, {10, 30, 0}, {10, -30, 0}, {10, 0, 8}, {1200, 0, 0}};
  for (const auto& [places, count] : {std::pair(seen, 1U), std::pair(unseen, 0U)}) {
    for (const Vector3d& place : places) {
      Scene scene;
      scene.meshes.push_back(SmallCard(eye + place));
      EXPECT_EQ(Visible(Chunks(scene), eye).size(), count) << place.transpose();
    }
  }
}

TEST(Culling, DrawsOpaqueFromNearToFarThenTransparent) {
  Scene scene;
  scene.textures.push_back(CheckerTexture({1, 2, 3, 0}, {1, 2, 3, 255}, 2, 2, 1));
  scene.meshes = {SmallCard({5, 0, 0}, 0), SmallCard({500, 0, 0}), SmallCard({70, 0, 0})};
  const ChunkedScene chunks = Chunks(scene);
  std::vector<float> order;
  for (const int i : Visible(chunks, Vector3d::Zero())) {
    order.push_back(chunks.chunks[static_cast<std::size_t>(i)].box.min().x());
  }
  EXPECT_THAT(order, testing::ElementsAre(70.0F, 500.0F, 5.0F));
}

TEST(SceneChunks, HoldEveryTriangleOnce) {
  const Scene scene = Street(5, 1);
  std::size_t indices = 0, drawn = 0;
  for (const SceneMesh& mesh : scene.meshes) indices += mesh.indices.size();
  const ChunkedScene chunks = Chunks(scene);
  for (const Chunk& chunk : chunks.chunks) {
    EXPECT_EQ(chunk.first_index, drawn);
    drawn += chunk.index_count;
  }
  EXPECT_EQ(drawn, indices);
  EXPECT_EQ(chunks.indices.size(), indices);
}

TEST(SceneChunks, TurnDoubleSidedTrianglesTowardsTheirNormals) {
  Scene scene;
  scene.meshes.push_back(SmallCard({5, 0, 0}));
  std::swap(scene.meshes[0].indices[0], scene.meshes[0].indices[1]);
  EXPECT_THAT(Chunks(scene).indices, testing::ElementsAre(1, 2, 0, 0, 2, 3));
}

TEST(SceneChunks, RefuseBadMeshes) {
  Scene scene;
  scene.meshes.push_back(SmallCard({5, 0, 0}));
  scene.meshes[0].name = "fence";
  scene.meshes[0].indices[4] = 9;
  EXPECT_THAT([&] { Chunks(scene); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("fence")));
  scene.meshes[0].indices[4] = 2;
  scene.meshes[0].vertices[1].position.x() = std::nanf("");
  EXPECT_THROW(Chunks(scene), InputError);
}

}  // namespace
}  // namespace lift_slam
