// All tracks of Debian's torcs-data.
#include <gmock/gmock.h>

#include "lift_slam/simulation/scene/scene_loader.h"
#include "lift_slam/simulation/scene/torcs_data.h"
#include "lift_slam/simulation/scene/torcs_road.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

std::vector<std::string> Tracks() {
  try {
    return ListTorcsTracks(TorcsFolder(""));
  } catch (const InputError&) {
    return {};
  }
}

void ExpectUsable(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  EXPECT_THAT(loaded.warnings, ::testing::IsEmpty());
  EXPECT_GE(scene.sky.texture, 0);
  EXPECT_FALSE(loaded.track->author.empty());
  std::size_t triangles = 0;
  for (const SceneMesh& mesh : scene.meshes) {
    triangles += mesh.indices.size() / 3;
    for (const SceneVertex& vertex : mesh.vertices) {
      ASSERT_TRUE(vertex.position.allFinite() && vertex.uv.allFinite());
      ASSERT_NEAR(vertex.normal.norm(), 1.0F, 1e-3F) << mesh.name;
    }
  }
  EXPECT_GT(triangles, 3000U);
}

void ExpectRoad(const Road& road) {
  EXPECT_GT(RoadLength(road), 1000.0);
  for (std::size_t i = 0; i < road.sections.size(); ++i) {
    const RoadSection& here = road.sections[i];
    const RoadSection& next = road.sections[(i + 1) % road.sections.size()];
    const Eigen::Vector3d step = next.Center() - here.Center();
    EXPECT_LT(step.norm(), 40.0) << i;
    const Eigen::Vector3d across = here.left - here.right;
    EXPECT_GT(step.x() * across.y() - step.y() * across.x(), 0.0) << i;
  }
}

TEST(TorcsTracks, AllLoadWithAClosedRoad) {
  const std::vector<std::string> tracks = Tracks();
  if (tracks.empty()) GTEST_SKIP() << "no torcs-data (LIFT_SLAM_TORCS or /usr/share/games/torcs)";
  EXPECT_GE(tracks.size(), 38U);
  for (const std::string& track : tracks) {
    SCOPED_TRACE(track);
    const LoadedScene loaded = LoadScene(track);
    ExpectUsable(loaded);
    ExpectRoad(FindTorcsRoad(loaded.scene));
  }
}

}  // namespace
}  // namespace lift_slam
