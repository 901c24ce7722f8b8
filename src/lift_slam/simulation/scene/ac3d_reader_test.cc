#include "lift_slam/simulation/scene/ac3d_reader.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "lift_slam/simulation/scene/ac3d_scene.h"
#include "lift_slam/simulation/scene/scene_test_files.h"

namespace lift_slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kHead[] =
    "AC3Db\n"
    "MATERIAL \"two words\" rgb 0.1 0.2 0.3  amb 1 1 1  emis 0.4 0.5 0.6  spec 0 0 0  shi 10  "
    "trans 0\n";

Ac3dModel Parse(const std::string& objects) { return ParseAc3d(kHead + objects, "x.ac"); }

Scene ToScene(const Ac3dModel& model) {
  Scene scene;
  TextureSet textures({}, &scene);
  AppendAc3d(model, textures, scene);
  return scene;
}

// A square of the xz plane as one surface of these flags and corners "vertex u v".
std::string Square(const std::string& flags, const std::string& refs) {
  return "OBJECT poly\nname \"square\"\nnumvert 4\n0 0 0\n1 0 0\n1 0 -1\n0 0 -1\nnumsurf 1\nSURF " +
         flags + "\nmat 0\n" + refs + "kids 0\n";
}

TEST(Ac3dReader, PolygonIsTurnedToZUpAndTriangulated) {
  const Scene scene = ToScene(Parse(Square("0x30", "refs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n")));
  ASSERT_EQ(scene.meshes.size(), 1U);
  const SceneMesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.name, "square");
  EXPECT_TRUE(mesh.double_sided);
  EXPECT_EQ(mesh.color, Eigen::Vector3f(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(mesh.emission, Eigen::Vector3f(0.4F, 0.5F, 0.6F));
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2].position, Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(mesh.vertices[2].uv, Eigen::Vector2f(1, 1));
  EXPECT_TRUE(mesh.vertices[2].normal.isApprox(Eigen::Vector3f::UnitZ()));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Ac3dReader, StripAlternatesItsSense) {
  const Scene scene = ToScene(Parse(Square("0x14", "refs 4\n0 0 0\n1 1 0\n3 0 1\n2 1 1\n")));
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_FALSE(scene.meshes[0].double_sided);
  for (const SceneVertex& vertex : scene.meshes[0].vertices) {
    EXPECT_TRUE(vertex.normal.isApprox(Eigen::Vector3f::UnitZ())) << vertex.normal.transpose();
  }
  EXPECT_EQ(scene.meshes[0].indices.size(), 6U);
}

TEST(Ac3dReader, DegenerateTrianglesOfAStripAreDropped) {
  const Scene scene = ToScene(Parse(Square("0x34", "refs 5\n1 0 0\n3 0 0\n1 0 0\n2 0 0\n0 0 0\n")));
  EXPECT_EQ(scene.meshes.at(0).indices.size(), 6U);
}

TEST(Ac3dReader, ConcavePolygonCoversItsOwnAreaOnly) {
  const Scene scene = ToScene(
      Parse("OBJECT poly\nnumvert 5\n0 0 0\n4 0 0\n4 0 -4\n2 0 -1\n0 0 -4\nnumsurf 1\nSURF 0x0\n"
            "mat 0\nrefs 5\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\nkids 0\n"));
  const SceneMesh& mesh = scene.meshes.at(0);
  float area = 0.0F;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Eigen::Vector3f a = mesh.vertices[mesh.indices[i]].position;
    const Eigen::Vector3f b = mesh.vertices[mesh.indices[i + 1]].position;
    const Eigen::Vector3f c = mesh.vertices[mesh.indices[i + 2]].position;
    const float signed_area = 0.5F * (b - a).cross(c - a).z();
    EXPECT_GT(signed_area, 0.0F);
    area += signed_area;
  }
  EXPECT_FLOAT_EQ(area, 10.0F);
}

TEST(Ac3dReader, LinesAreLeftOut) {
  EXPECT_TRUE(Parse(Square("0x21", "refs 3\n0 0 0\n1 1 0\n2 1 1\n")).objects.empty());
  EXPECT_TRUE(Parse(Square("0x22", "refs 2\n0 0 0\n1 1 0\n")).objects.empty());
}

std::string Layers(const std::string& textures, const std::string& corner_rest) {
  return "OBJECT poly\nname \"a\"\n" + textures +
         "numvert 3\n0 0 0 0 1 0\n1 0 0 0 1 0\n0 0 -1 0 1 0\nnumsurf 1\nSURF 0x14\nmat 0\n"
         "refs 3\n0" +
         corner_rest + "1" + corner_rest + "2" + corner_rest + "kids 0\n";
}

TEST(Ac3dReader, ShadowMapHasTheSecondPair) {
  const Ac3dModel model =
      Parse(Layers("texture \"road.png\" base\ntexture \"shadow2.rgb\" tiled\n"
                   "texture \"raceline.png\" skids\ntexture empty_texture_no_mapping shad\n",
                   " 1 2 3 4 5 6 \n"));
  const Ac3dObject& object = model.objects.at(0);
  EXPECT_EQ(object.texture, "road.png");
  EXPECT_EQ(object.shade_texture, "shadow2.rgb");
  EXPECT_EQ(object.surfaces.at(0).corners.at(0).uv, Eigen::Vector2f(1, 2));
  EXPECT_EQ(object.surfaces.at(0).corners.at(0).shade_uv, Eigen::Vector2f(3, 4));
  EXPECT_EQ(object.normals.at(0), Eigen::Vector3f(0, 0, 1));
}

TEST(Ac3dReader, SkidMarksWithoutShadowMapAreNoShadowMap) {
  const Ac3dModel model =
      Parse(Layers("texture \"road.png\" base\ntexture empty_texture_no_mapping tiled\n"
                   "texture \"raceline.png\" skids\n",
                   " 1 2 5 6\n"));
  EXPECT_EQ(model.objects.at(0).shade_texture, "");
}

TEST(Ac3dReader, PlainTextureWithRepeatAndOffset) {
  const Ac3dModel model =
      Parse(Layers("texture \"my road.png\"\ntexrep 2 3\ntexoff 0.5 0.25\n", " 1 1\n"));
  EXPECT_EQ(model.objects.at(0).texture, "my road.png");
  EXPECT_EQ(model.objects.at(0).surfaces.at(0).corners.at(0).uv, Eigen::Vector2f(2.5F, 3.25F));
}

TEST(Ac3dReader, PlacesNestedGroups) {
  // The outer group turns x to z (rows multiply from the right), the inner one moves along x.
  const Ac3dModel model = Parse(
      "OBJECT world\nkids 1\nOBJECT group\nrot 0 0 1 0 1 0 -1 0 0\nloc 10 0 0\nkids 1\n"
      "OBJECT group\nloc 1 0 0\nkids 1\n" +
      Square("0x30", "refs 3\n0 0 0\n1 1 0\n2 1 1\n"));
  // File: (0,0,0) -> (1,0,0) -> (10,0,1); scene: (10,-1,0).
  EXPECT_TRUE(model.objects.at(0).vertices.at(0).isApprox(Eigen::Vector3f(10, -1, 0)));
}

TEST(Ac3dReader, OnlyTorcsFilesMayLackChildren) {
  const std::string text =
      kHead + ("OBJECT world\nkids 3\n" + Square("0x30", "refs 3\n0 0 0\n1 1 0\n2 1 1\n"));
  EXPECT_EQ(ParseAc3d(text, "x.acc").objects.size(), 1U);
  EXPECT_THAT(InputErrorOf([&] { ParseAc3d(text, "x.ac"); }), HasSubstr("child 2 of 3"));
}

TEST(Ac3dReader, SkipsUserDataAndUnknownEntries) {
  const Ac3dModel model = Parse("OBJECT world\ndata 9\nnumvert 5\nurl \"x\"\nlocked\nkids 1\n" +
                                Square("0x30", "refs 3\n0 0 0\n1 1 0\n2 1 1\n"));
  EXPECT_EQ(model.objects.size(), 1U);
}

TEST(Ac3dReader, CreaseSeparatesNormals) {
  // A roof of two faces at right angles: an edge for a crease of 61 degrees, smooth for 100.
  const auto roof = [](const std::string& crease) {
    return "OBJECT poly\n" + crease +
           "numvert 4\n0 0 0\n0 0 -1\n-1 -1 0\n1 -1 0\nnumsurf 2\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n"
           "1 0 0\n2 0 0\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n3 0 0\n1 0 0\nkids 0\n";
  };
  EXPECT_EQ(ToScene(Parse(roof(""))).meshes.at(0).vertices.size(), 6U);
  const Scene smooth = ToScene(Parse(roof("crease 100\n")));
  EXPECT_EQ(smooth.meshes.at(0).vertices.size(), 4U);
  EXPECT_TRUE(smooth.meshes[0].vertices[0].normal.isApprox(Eigen::Vector3f::UnitZ()));
}

TEST(Ac3dReader, NamesTheLineOfWhatIsWrong) {
  const auto error = [](const std::string& objects) {
    return InputErrorOf([&] { Parse(objects); });
  };
  EXPECT_THAT(InputErrorOf([] { ParseAc3d("solid cube\n", "x.ac"); }), HasSubstr("x.ac:1:"));
  EXPECT_THAT(InputErrorOf([] { ParseAc3d("", "x.ac"); }), HasSubstr("AC3D"));
  EXPECT_THAT(error("CUBE\n"), HasSubstr("x.ac:3: expected MATERIAL or OBJECT, found 'CUBE'"));
  EXPECT_THAT(error("OBJECT world\nkids 2\n"), HasSubstr("child 1 of 2"));
  EXPECT_THAT(error("OBJECT poly\nnumvert 2\n0 0 0\n0 zero 0\n"), HasSubstr("x.ac:6:"));
  EXPECT_THAT(error("OBJECT poly\nnumvert 1\n0 0 0\n0 0 0\n"), HasSubstr("found '0'"));
  EXPECT_THAT(error("OBJECT poly\nnumvert -1\n"), HasSubstr("found '-1'"));
  EXPECT_THAT(error("OBJECT poly\nnumvert 1\nnan 0 0\nkids 0\n"), HasSubstr("found 'nan'"));
  EXPECT_THAT(error(Square("0x30", "refs 3\n0 0 0\n1 1 0\n4 1 1\n")), HasSubstr("vertex 4 of 4"));
  EXPECT_THAT(
      error("OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0\nmat 7\nrefs 3\n"
            "0 0 0\n1 0 0\n2 0 0\nkids 0\n"),
      HasSubstr("material 7 of 1"));
}

TEST(Ac3dReader, RefusesEndlessNesting) {
  std::string objects;
  for (int i = 0; i < 5000; ++i) objects += "OBJECT group\nkids 1\n";
  EXPECT_THAT(InputErrorOf([&] { Parse(objects); }), HasSubstr("nested deeper"));
}

TEST(Ac3dReader, EveryCutIsRefusedOrRead) {
  const std::string whole =
      kHead + ("OBJECT world\nkids 1\n" + Square("0x30", "refs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    try {
      ParseAc3d(std::string_view(whole).substr(0, size), "cut.ac");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.ac:"));
    }
  }
}

}  // namespace
}  // namespace lift_slam
