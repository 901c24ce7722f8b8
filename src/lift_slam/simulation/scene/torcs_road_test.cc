#include "lift_slam/simulation/scene/torcs_road.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "lift_slam/simulation/scene/road_piece.h"
#include "lift_slam/simulation/scene/scene_test_files.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

constexpr int kRungs = 48;
constexpr double kWidthM = 8.0;

// Cross-section i of an oval driven counter-clockwise: left is inside.
RoadSection Section(int i) {
  const double angle = 2.0 * std::numbers::pi * i / kRungs;
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d center(100.0 * out.x(), 60.0 * out.y(), 5.0 * out.x());
  return {center - 0.5 * kWidthM * out, center + 0.5 * kWidthM * out};
}

void AddVertex(const Eigen::Vector3d& position, SceneMesh& mesh) {
  mesh.vertices.push_back({position.cast<float>(), Eigen::Vector3f::UnitZ(),
                           Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()});
}

// A ladder of quadrilaterals from rung `first` to rung `last`.
SceneMesh Ladder(const std::string& name, int first, int last) {
  SceneMesh mesh;
  mesh.name = name;
  for (int i = first; i <= last; ++i) {
    AddVertex(Section(i % kRungs).left, mesh);
    AddVertex(Section(i % kRungs).right, mesh);
  }
  for (std::uint32_t v = 0; v + 3 < mesh.vertices.size(); v += 2) {
    mesh.indices.insert(mesh.indices.end(), {v, v + 1, v + 2, v + 2, v + 1, v + 3});
  }
  return mesh;
}

Scene Oval() {
  Scene scene;
  scene.name = "oval";
  scene.meshes.push_back(Ladder("TKMN24", 24, 36));
  scene.meshes.push_back(Ladder("tkMn0", 0, 12));
  scene.meshes.push_back(Ladder("TKMN36", 36, 48));
  scene.meshes.push_back(Ladder("TKMN12", 12, 24));
  return scene;
}

void ExpectOval(const Road& road) {
  ASSERT_EQ(road.sections.size(), static_cast<std::size_t>(kRungs));
  for (int i = 0; i < kRungs; ++i) {
    const RoadSection& section = road.sections[static_cast<std::size_t>(i)];
    EXPECT_LT((section.left - Section(i).left).norm(), 1e-4) << i;
    EXPECT_LT((section.right - Section(i).right).norm(), 1e-4) << i;
  }
}

TEST(TorcsRoad, JoinsPiecesInDrivingOrder) { ExpectOval(FindTorcsRoad(Oval())); }

TEST(TorcsRoad, PiecesStoredBackwardsMakeNoDifference) {
  Scene scene = Oval();
  std::reverse(scene.meshes[0].vertices.begin(), scene.meshes[0].vertices.end());
  std::reverse(scene.meshes[3].vertices.begin(), scene.meshes[3].vertices.end());
  ExpectOval(FindTorcsRoad(scene));
}

TEST(TorcsRoad, OrderOfVerticesMakesNoDifference) {
  Scene scene = Oval();
  SceneMesh& mesh = scene.meshes[1];
  std::swap(mesh.vertices[5], mesh.vertices[8]);
  for (std::uint32_t& index : mesh.indices) index = index == 5 ? 8 : index == 8 ? 5 : index;
  ExpectOval(FindTorcsRoad(scene));
}

TEST(TorcsRoad, SingleQuadrilateralsAreRoadToo) {
  Scene scene = Oval();
  scene.meshes.erase(scene.meshes.begin());
  scene.meshes.push_back(Ladder("TKMN24", 24, 25));
  scene.meshes.push_back(Ladder("TKMN25", 25, 36));
  ExpectOval(FindTorcsRoad(scene));
}

TEST(TorcsRoad, StrayMeshesOfTheSameNameAreLeftOut) {
  Scene scene = Oval();
  SceneMesh wall = Ladder("TKMN00001", 3, 6);
  for (SceneVertex& vertex : wall.vertices) vertex.position.z() += 7.0F;
  scene.meshes.push_back(wall);
  SceneMesh triangle = Ladder("TKMN7", 3, 4);
  triangle.indices.resize(3);
  scene.meshes.push_back(triangle);
  ExpectOval(FindTorcsRoad(scene));
}

TEST(TorcsRoad, MeshOfAnotherNameClosesAGap) {
  Scene scene = Oval();
  scene.meshes[2] = Ladder("TKMN36", 36, 47);
  EXPECT_THROW(FindTorcsRoad(scene), InputError);
  scene.meshes.push_back(Ladder("start line", 47, 48));
  ExpectOval(FindTorcsRoad(scene));
}

TEST(TorcsRoad, SmallStepIsAllowedAGapIsRefusedWithItsPlace) {
  Scene scene = Oval();
  const auto lift = [&](float height_m) {
    Scene lifted = scene;
    for (SceneVertex& vertex : lifted.meshes[0].vertices) vertex.position.z() += height_m;
    return lifted;
  };
  EXPECT_EQ(FindTorcsRoad(lift(0.5F)).sections.size(), static_cast<std::size_t>(kRungs));
  const std::string error = InputErrorOf([&] { FindTorcsRoad(lift(2.0F)); });
  EXPECT_THAT(error, HasSubstr("oval"));
  EXPECT_THAT(error, HasSubstr("gap of 2.0 m at ("));
}

TEST(TorcsRoad, SceneWithoutRoadIsRefused) {
  Scene scene;
  scene.name = "room";
  scene.meshes.push_back(Ladder("TKMNB", 0, 4));
  EXPECT_THAT(InputErrorOf([&] { FindTorcsRoad(scene); }), HasSubstr("room: no road"));
}

TEST(Road, LengthIsOfTheClosedLoop) {
  Road road;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(3, 4, 0)}) {
    road.sections.push_back({p, p});
  }
  EXPECT_DOUBLE_EQ(RoadLength(road), 12.0);
  EXPECT_EQ(RoadLength({}), 0.0);
}

}  // namespace
}  // namespace lift_slam
