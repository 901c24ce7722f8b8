#include "lift_slam/simulation/scene/scene_loader.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "lift_slam/simulation/scene/scene_test_files.h"

namespace lift_slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kTriangle[] =
    "AC3Db\nMATERIAL \"\" rgb 0.4 0.4 0.4 amb 1 1 1 emis 0.4 0.4 0.4 spec 0 0 0 shi 1 trans 0\n"
    "OBJECT poly\nname \"TKMN0\"\ntexture \"road.rgb\" base\ntexture \"shade.rgb\" tiled\n"
    "numvert 3\n0 0 0 0 1 0\n1 0 0 0 1 0\n0 0 -1 0 1 0\nnumsurf 1\nSURF 0x14\nmat 0\nrefs 3\n"
    "0 0 0 0 0\n1 1 0 1 0\n2 1 1 1 1\nkids 0\n";

std::string TrackXml(const std::string& graphic) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- comment -->\n"
         "<!DOCTYPE params SYSTEM \"../params.dtd\" [\n"
         "<!ENTITY default-surfaces SYSTEM \"../surfaces.xml\">\n]>\n"
         "<params name=\"hill\"><section name=\"Surfaces\">&default-surfaces;</section>\n"
         "<section name=\"Header\"><attstr name=\"name\" val=\"The Hill\"/>"
         "<attstr name=\"author\" val=\"A. Author\"/><attstr name=\"category\" val=\"road\"/>"
         "</section>\n<section name=\"Graphic\"><attstr name=\"3d description\" "
         "val=\"hill.acc\"/>" +
         graphic + "</section></params>\n";
}

constexpr char kBackground[] = "<attstr name=\"background image\" val=\"sky.rgb\"/>";

// A small copy of TORCS's folders: track road/hill with two of its own textures, one shared.
class Torcs {
 public:
  explicit Torcs(const std::string& graphic = kBackground) {
    files_.Write("tracks/road/hill/hill.acc", kTriangle);
    files_.Write("tracks/road/hill/hill.xml", TrackXml(graphic));
    files_.Write("tracks/road/hill/road.rgb", SgiBytes(1, 1, 3, "\x10\x20\x30"));
    files_.Write("data/textures/shade.rgb", SgiBytes(1, 1, 1, "\x40"));
    // Bottom row 10, 20, top row 30, 40.
    files_.Write("tracks/road/hill/sky.rgb", SgiBytes(2, 2, 1, "\x0A\x14\x1E\x28"));
    options_.torcs_folder = files_.path().string();
  }
  LoadedScene Load(const std::string& name = "hill") const { return LoadScene(name, options_); }
  const TemporaryFolder& files() const { return files_; }

 private:
  TemporaryFolder files_;
  SceneLoaderOptions options_;
};

TEST(SceneLoader, TrackByNameFolderAndMesh) {
  const Torcs torcs;
  const std::string folder = (torcs.files().path() / "tracks/road/hill").string();
  for (const std::string& name :
       {std::string("hill"), std::string("road/hill"), folder, folder + "/hill.acc"}) {
    const LoadedScene loaded = torcs.Load(name);
    ASSERT_TRUE(loaded.track.has_value()) << name;
    EXPECT_EQ(loaded.track->title, "The Hill");
    EXPECT_EQ(loaded.track->author, "A. Author");
    EXPECT_EQ(loaded.track->category, "road");
    EXPECT_EQ(loaded.scene.name, "hill");
    EXPECT_THAT(loaded.warnings, IsEmpty());
  }
}

TEST(SceneLoader, TexturesOfTheTrackAndShared) {
  const Scene scene = Torcs().Load().scene;
  ASSERT_EQ(scene.meshes.size(), 1U);
  const SceneMesh& mesh = scene.meshes[0];
  ASSERT_GE(mesh.texture, 0);
  ASSERT_GE(mesh.shade_texture, 0);
  EXPECT_THAT(scene.textures[static_cast<std::size_t>(mesh.texture)].rgba,
              ElementsAre(0x10, 0x20, 0x30, 255));
  EXPECT_THAT(scene.textures[static_cast<std::size_t>(mesh.shade_texture)].rgba,
              ElementsAre(0x40, 0x40, 0x40, 255));
}

const SceneTexture& SkyPicture(const Scene& scene) {
  return scene.textures.at(static_cast<std::size_t>(scene.sky.texture));
}

TEST(SceneLoader, SkyOnceAround) {
  const Scene scene =
      Torcs(std::string(kBackground) + "<attnum name=\"background type\" val=\"4\"/>").Load().scene;
  EXPECT_DOUBLE_EQ(scene.sky.repeats, 1.0);
  EXPECT_DOUBLE_EQ(scene.sky.bottom_elevation_rad, std::atan(-1.0));
  EXPECT_EQ(SkyPicture(scene).rgba[0], 30);
  EXPECT_NEAR(scene.sky.color[0] * 255.0F, 35.0F, 1e-3F);
  EXPECT_NEAR(scene.sky.color_below[0] * 255.0F, 15.0F, 1e-3F);
}

TEST(SceneLoader, SkyOfTwoHalvesByTurns) {
  const Scene scene =
      Torcs(std::string(kBackground) + "<attnum name=\"background type\" val=\"2\"/>").Load().scene;
  EXPECT_DOUBLE_EQ(scene.sky.repeats, 2.0);
  const SceneTexture& strip = SkyPicture(scene);
  EXPECT_EQ(strip.width, 4);
  EXPECT_EQ(strip.height, 1);
  EXPECT_THAT((std::vector<int>{strip.rgba[0], strip.rgba[4], strip.rgba[8], strip.rgba[12]}),
              ElementsAre(10, 20, 30, 40));
}

TEST(SceneLoader, TransparentSkyShowsTheBackgroundColour) {
  const Torcs torcs(std::string(kBackground) + "<attnum name=\"background color R\" val=\"1\"/>");
  torcs.files().Write("tracks/road/hill/sky.rgb", SgiBytes(1, 1, 4, std::string(4, '\0')));
  EXPECT_EQ(SkyPicture(torcs.Load().scene).rgba[0], 255);
}

TEST(SceneLoader, BlackBottomOfTheSkyTakesTheColourAboveIt) {
  const Torcs torcs;
  torcs.files().Write("tracks/road/hill/sky.rgb",
                      SgiBytes(1, 6, 1, std::string(3, '\0') + "\x11\x22\x33"));
  const SceneTexture sky = SkyPicture(torcs.Load().scene);
  EXPECT_EQ(sky.rgba[0], 0x33);
  EXPECT_EQ(sky.rgba[4 * 5], 0x33);
}

TEST(SceneLoader, LightPointsToTheSun) {
  const Scene scene = Torcs(
                          "<attnum name=\"light position x\" val=\"30\"/>"
                          "<attnum name=\"light position z\" val=\"40\"/>"
                          "<attnum name=\"ambient color G\" val=\"0.5\"/>")
                          .Load()
                          .scene;
  EXPECT_TRUE(scene.light.to_sun.isApprox(Eigen::Vector3f(0.6F, 0, 0.8F)));
  EXPECT_FLOAT_EQ(scene.light.ambient.y(), 0.7F);
  EXPECT_EQ(scene.sky.texture, -1);
}

TEST(SceneLoader, MissingTextureIsAWarning) {
  const Torcs torcs;
  std::filesystem::remove(torcs.files().path() / "data/textures/shade.rgb");
  const LoadedScene loaded = torcs.Load();
  EXPECT_EQ(loaded.scene.meshes.at(0).shade_texture, -1);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("1 texture not found")));
  EXPECT_THAT(loaded.warnings[0], HasSubstr("shade.rgb"));
}

TEST(SceneLoader, MeshWithoutTexturesIsRefused) {
  const Torcs torcs;
  std::filesystem::remove(torcs.files().path() / "tracks/road/hill/road.rgb");
  EXPECT_THAT(InputErrorOf([&] { torcs.Load(); }), HasSubstr("a mesh without textures"));
}

TEST(SceneLoader, UnknownTrackListsTheKnownOnes) {
  const std::string error = InputErrorOf([] { Torcs().Load("hil"); });
  EXPECT_THAT(error, HasSubstr("'hil' is neither"));
  EXPECT_THAT(error, HasSubstr("nearest: hill"));
  EXPECT_THAT(error, HasSubstr("known tracks: hill"));
}

TEST(SceneLoader, MissingTorcsDataNamesThePackage) {
  const TemporaryFolder empty;
  SceneLoaderOptions options;
  options.torcs_folder = empty.path().string();
  EXPECT_THAT(InputErrorOf([&] { LoadScene("dirt-3", options); }), HasSubstr("torcs-data"));
}

TEST(SceneLoader, MissingFileAndBadDescriptionAreRefused) {
  EXPECT_THAT(InputErrorOf([] { LoadScene("none/scene.glb"); }), HasSubstr("none/scene.glb"));
  EXPECT_THAT(InputErrorOf([] { Torcs("<attnum name=\"light position x\" val=\"far\"/>").Load(); }),
              HasSubstr("light position x: expected a number, found 'far'"));
  EXPECT_THAT(InputErrorOf([] { Torcs("<attnum name=\"x\" val=\"1\">").Load(); }),
              HasSubstr("no valid XML"));
  EXPECT_THAT(
      InputErrorOf([] {
        Torcs(std::string(kBackground) + "<attnum name=\"background type\" val=\"3\"/>").Load();
      }),
      HasSubstr("expected 0, 2 or 4, found 3"));
}

std::string CubeFace(const std::string& material_file) {
  return "mtllib " + material_file +
         "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wall\n"
         "f 1/1 2/2 3/3 4/4\n";
}

TEST(SceneLoader, ObjIsTurnedToZUp) {
  const TemporaryFolder files;
  files.Write("wall.mtl", "newmtl wall\nKd 0.5 0.6 0.7\nmap_Kd wall.rgb\n");
  files.Write("wall.rgb", SgiBytes(1, 1, 3, "\x01\x02\x03"));
  const std::string path = files.Write("wall.obj", CubeFace("wall.mtl")).string();
  const LoadedScene loaded = LoadScene(path);
  ASSERT_EQ(loaded.scene.meshes.size(), 1U);
  const SceneMesh& mesh = loaded.scene.meshes[0];
  EXPECT_EQ(mesh.indices.size(), 6U);
  EXPECT_EQ(mesh.texture, 0);
  EXPECT_TRUE(mesh.color.isApprox(Eigen::Vector3f(0.5F, 0.6F, 0.7F)));
  for (const SceneVertex& vertex : mesh.vertices) {
    EXPECT_EQ(vertex.position.y(), 0.0F);
    EXPECT_EQ(vertex.uv, Eigen::Vector2f(vertex.position.x(), vertex.position.z()));
    EXPECT_TRUE(vertex.normal.isApprox(-Eigen::Vector3f::UnitY()));
  }
  SceneLoaderOptions z_up;
  z_up.up_axis = UpAxis::kZ;
  const LoadedScene as_stored = LoadScene(path, z_up);
  for (const SceneVertex& vertex : as_stored.scene.meshes.at(0).vertices) {
    EXPECT_EQ(vertex.position.z(), 0.0F);
  }
}

TEST(SceneLoader, ObjWithoutTexturesAndBrokenFilesAreRefused) {
  const TemporaryFolder files;
  files.Write("wall.mtl", "newmtl wall\nKd 0.5 0.6 0.7\n");
  const std::string plain = files.Write("wall.obj", CubeFace("wall.mtl")).string();
  EXPECT_THAT(InputErrorOf([&] { LoadScene(plain); }), HasSubstr("a mesh without textures"));
  const std::string broken = files.Write("broken.glb", "no scene").string();
  EXPECT_THAT(InputErrorOf([&] { LoadScene(broken); }), HasSubstr("broken.glb"));
  const std::string unknown = files.Write("scene.xyz", "no scene").string();
  EXPECT_THAT(InputErrorOf([&] { LoadScene(unknown); }), HasSubstr("scene.xyz"));
}

// One triangle with a 1x1 PNG in the file itself, in a node that moves it by 5 along x.
TEST(SceneLoader, GltfWithEmbeddedTextureAndMovedNode) {
  const TemporaryFolder files;
  const std::string path =
      files
          .Write("a.gltf",
                 R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[5,0,0]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGMQUDAAAACkAGE0Zn1yAAAAAElFTkSuQmCC"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAIA/AACAPwAAgD8AAAAA"}]})")
          .string();
  const Scene scene = LoadScene(path).scene;
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.meshes[0].texture, 0);
  EXPECT_EQ(scene.textures.at(0).width, 1);
  EXPECT_EQ(scene.meshes[0].vertices.at(0).position, Eigen::Vector3f(5, 0, 0));
  EXPECT_EQ(scene.meshes[0].vertices.at(2).position, Eigen::Vector3f(6, 0, 1));
  // glTF's v grows downwards: 1 in the file is the picture's bottom.
  EXPECT_EQ(scene.meshes[0].vertices.at(0).uv, Eigen::Vector2f(0, 0));
  EXPECT_EQ(scene.meshes[0].vertices.at(2).uv, Eigen::Vector2f(1, 1));
}

}  // namespace
}  // namespace lift_slam
