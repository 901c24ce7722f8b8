#include "lift_slam/simulation/rendering/scene_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>

#include "lift_slam/simulation/rendering/scene_for_test.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeightM = 1.65;  // of the camera above the ground

RenderedView Render(const Scene& scene, const Camera& camera, const RenderQuality& quality = {},
                    const Vector3d& center = Vector3d::Zero()) {
  return SceneRenderer(scene, camera, quality).Render(LookingAlongX(center));
}

Eigen::Vector3i Pixel(const RenderedView& view, int x, int y) {
  const std::uint8_t* rgb = view.rgb.data() + 3 * (y * view.width + x);
  return {rgb[0], rgb[1], rgb[2]};
}

int Difference(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// Where the light of the picture is, on average.
Vector2d Centroid(const RenderedView& view) {
  Vector2d sum = Vector2d::Zero();
  double weights = 0.0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double weight = Pixel(view, x, y).x();
      sum += weight * Vector2d(x, y);
      weights += weight;
    }
  }
  return sum / weights;
}

// The centre of a polygon's area.
Vector2d PolygonCentroid(const std::vector<Vector2d>& corners) {
  Vector2d sum = Vector2d::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    sum += cross * (a + b);
    area += 3.0 * cross;
  }
  return sum / area;
}

// Draws a disc of about 6 pixels radius around a pixel; returns how far its centre is from where
// the camera projects it.
Vector2d DiscError(const Camera& camera, const Vector2d& pixel, const Vector3d& center,
                   int supersampling) {
  const Rigid3d cam_from_scene = LookingAlongX(center);
  const Vector3d in_scene = Inverse(cam_from_scene) * (20.0 * camera.Unproject(pixel).value());
  Scene scene = DarkScene();
  scene.meshes.push_back(Disc(in_scene, center - in_scene, 120.0 / camera.pinhole.fx));
  std::vector<Vector2d> outline;
  for (const SceneVertex& vertex : scene.meshes[0].vertices) {
    outline.push_back(camera.Project(cam_from_scene * vertex.position.cast<double>()).value());
  }
  RenderQuality quality;
  quality.supersampling = supersampling;
  const RenderedView view = SceneRenderer(scene, camera, quality).Render(cam_from_scene);
  return Centroid(view) - PolygonCentroid(outline);
}

// Single discs scatter by the samples at their outlines; a shift would show in the mean.
TEST(SceneRenderer, DrawsPointsWhereAPinholeProjectsThem) {
  for (const int supersampling : {1, 2, 3, 4}) {
    Vector2d sum = Vector2d::Zero();
    for (const Vector2d& pixel : {Vector2d(80.3, 50.1), Vector2d(12.7, 9.4), Vector2d(147.2, 8.9),
                                  Vector2d(20.8, 83.6), Vector2d(117.5, 84.3)}) {
      const Vector2d error = DiscError(TestCamera(160, 96), pixel, Vector3d::Zero(), supersampling);
      EXPECT_LT(error.norm(), 0.15 / supersampling) << supersampling << " at " << pixel.transpose();
      sum += error;
    }
    EXPECT_LT(sum.norm() / 5.0, supersampling == 1 ? 0.05 : 0.02) << supersampling;
  }
}

TEST(SceneRenderer, KeepsItsDigitsFarFromTheOrigin) {
  const Vector3d center(8123.4567, -6789.123, 234.567);
  EXPECT_LT(DiscError(TestCamera(160, 96), {40.3, 20.1}, center, 4).norm(), 0.04);
}

Camera Distorted(const Distortion& distortion, double focal) {
  Camera camera = TestCamera(200, 120);
  camera.pinhole.fx = camera.pinhole.fy = focal;
  camera.distortion = distortion;
  return camera;
}

// All kinds of lenses, from narrow to as wide as a camera can be.
std::vector<Camera> Lenses() {
  return {Distorted(RadialTangential{-0.28, 0.07, 0.0002, 0.00002, 0.0}, 110.0),
          Distorted(KannalaBrandt{-0.01, 0.02, -0.01, 0.001}, 90.0),
          Distorted(KannalaBrandt{0.0, 0.0, 0.0, 0.0}, 65.0), Distorted(FieldOfView{0.9}, 80.0)};
}

TEST(SceneRenderer, DrawsPointsWhereADistortedCameraProjectsThem) {
  for (const Camera& camera : Lenses()) {
    for (const Vector2d& pixel : {Vector2d(99.7, 60.4), Vector2d(15.3, 61.2), Vector2d(20.6, 14.8),
                                  Vector2d(183.1, 104.3), Vector2d(101.2, 110.6)}) {
      EXPECT_LT(DiscError(camera, pixel, Vector3d::Zero(), 2).norm(), 0.1)
          << camera.ModelName() << " " << camera.pinhole.fx << " at " << pixel.transpose();
    }
  }
}

Scene GroundScene() {
  Scene scene = DarkScene();
  scene.textures.push_back(CheckerTexture({200, 200, 200, 255}, {50, 50, 50, 255}, 4, 4, 8));
  scene.meshes.push_back(Card({-900.0, -900.0, 0.0}, {1800.0, 0.0, 0.0}, {0.0, 1800.0, 0.0}, 0));
  return scene;
}

// Depth of the ground in a pixel, 0 above the horizon or 100 m away.
double GroundDepth(const Camera& camera, int x, int y) {
  const auto ray = camera.Unproject({x, y});
  if (!ray || ray->y() <= 0.0) return 0.0;
  const Vector3d hit = *ray * (kHeightM / ray->y());
  return hit.norm() < 100.0 ? hit.z() : 0.0;
}

// Largest relative error of the depth over the ground nearer than 100 m.
double GroundDepthError(const Camera& camera, int supersampling) {
  RenderQuality quality;
  quality.supersampling = supersampling;
  const RenderedView view = Render(GroundScene(), camera, quality, {0.0, 0.0, kHeightM});
  double worst = 0.0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double expected = GroundDepth(camera, x, y);
      if (expected <= 0.0) continue;
      const double depth = view.depth_m[static_cast<std::size_t>(y * view.width + x)];
      worst = std::max(worst, std::abs(depth / expected - 1.0));
    }
  }
  return worst;
}

TEST(SceneRenderer, DepthIsExactAtPixelCenters) {
  for (const int supersampling : {1, 2, 3}) {
    EXPECT_LT(GroundDepthError(TestCamera(160, 96), supersampling), 2e-4) << supersampling;
  }
}

TEST(SceneRenderer, DepthIsExactThroughLenses) {
  for (const Camera& camera : Lenses()) {
    EXPECT_LT(GroundDepthError(camera, 2), 2e-3) << camera.ModelName() << camera.pinhole.fx;
  }
}

TEST(SceneRenderer, DepthOfTheSkyIsZero) {
  const RenderedView view = Render(GroundScene(), TestCamera(160, 96), {}, {0, 0, kHeightM});
  EXPECT_EQ(view.depth_m[80], 0.0F);
  EXPECT_EQ(view.depth_m.size(), 160U * 96U);
  EXPECT_EQ(view.rgb.size(), 3U * 160U * 96U);
}

TEST(SceneRenderer, SameBytesFromEveryRendererAndThread) {
  const Scene scene = Street(4, 7);
  for (const Camera& camera : {TestCamera(160, 96), Lenses()[1]}) {
    const Rigid3d pose = LookingAlongX({3.0, 0.5, kHeightM});
    SceneRenderer renderer(scene, camera, {});
    const RenderedView first = renderer.Render(pose);
    renderer.Render(LookingAlongX({10.0, 0.0, kHeightM}));
    const RenderedView again = renderer.Render(pose);
    RenderedView elsewhere, moved;
    std::thread([&] { elsewhere = SceneRenderer(scene, camera, {}).Render(pose); }).join();
    std::thread([&] { moved = renderer.Render(pose); }).join();
    for (const auto& other :
         {std::cref(again), std::cref(std::as_const(elsewhere)), std::cref(std::as_const(moved))}) {
      EXPECT_TRUE(first.rgb == other.get().rgb);
      EXPECT_TRUE(first.depth_m == other.get().depth_m);
    }
  }
}

TEST(SceneRenderer, ManyRenderersWorkSideBySide) {
  const Scene scene = Street(3, 7);
  const Camera camera = TestCamera(120, 80);
  const auto poses = [](int i) { return LookingAlongX({1.0 * i, 0.0, kHeightM}); };
  std::vector<RenderedView> alone, together(8);
  SceneRenderer renderer(scene, camera, {});
  for (int i = 0; i < 8; ++i) alone.push_back(renderer.Render(poses(i)));
  std::vector<std::thread> threads;
  for (int first : {0, 1, 2}) {
    threads.emplace_back([&, first] {
      SceneRenderer own(scene, camera, {});
      for (int i = first; i < 8; i += 3)
        together[static_cast<std::size_t>(i)] = own.Render(poses(i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(alone[i].rgb == together[i].rgb) << i;
}

// A card that fills the middle of the picture, 10 m ahead.
SceneMesh CardAhead(int texture) {
  return Card({10.0, 5.0, -3.0}, {0.0, -10.0, 0.0}, {0.0, 0.0, 6.0}, texture);
}

TEST(SceneRenderer, TexturesStandUpright) {
  Scene scene = DarkScene();
  SceneTexture texture{"quarters", 2, 2, false, {}};
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  scene.textures.push_back(texture);
  scene.meshes.push_back(CardAhead(0));
  const RenderedView view = Render(scene, TestCamera(160, 96));
  // The card reaches from pixel 31.6 to 125.2 and from 21.3 to 78.5; look at the texels' centres.
  EXPECT_LT(Difference(Pixel(view, 55, 36), {255, 0, 0}), 10);
  EXPECT_LT(Difference(Pixel(view, 102, 36), {0, 255, 0}), 10);
  EXPECT_LT(Difference(Pixel(view, 55, 64), {0, 0, 255}), 10);
  EXPECT_LT(Difference(Pixel(view, 102, 64), {255, 255, 255}), 10);
}

TEST(SceneRenderer, ShadeTextureDarkens) {
  Scene scene = DarkScene();
  scene.textures.push_back(CheckerTexture({100, 200, 50, 255}, {100, 200, 50, 255}, 1, 1, 4));
  scene.textures.push_back(CheckerTexture({128, 128, 128, 255}, {128, 128, 128, 255}, 1, 1, 4));
  scene.meshes.push_back(CardAhead(0));
  scene.meshes[0].shade_texture = 1;
  EXPECT_EQ(Pixel(Render(scene, TestCamera(160, 96)), 80, 50), Eigen::Vector3i(50, 100, 25));
}

TEST(SceneRenderer, SeesThroughTransparentTexels) {
  Scene scene = DarkScene();
  scene.textures.push_back(CheckerTexture({255, 0, 0, 255}, {0, 255, 0, 0}, 2, 1, 8));
  scene.meshes.push_back(CardAhead(0));
  scene.meshes.push_back(Card({20.0, 40.0, -40.0}, {0.0, -80.0, 0.0}, {0.0, 0.0, 80.0}, -1));
  const RenderedView view = Render(scene, TestCamera(160, 96));
  EXPECT_EQ(Pixel(view, 55, 50), Eigen::Vector3i(255, 0, 0));
  EXPECT_NEAR(view.depth_m[50 * 160 + 55], 10.0, 1e-3);
  EXPECT_EQ(Pixel(view, 102, 50), Eigen::Vector3i(255, 255, 255));
  EXPECT_NEAR(view.depth_m[50 * 160 + 102], 20.0, 1e-3);
}

TEST(SceneRenderer, BackOfSingleSidedMeshesIsUnseen) {
  Scene scene = DarkScene();
  scene.meshes.push_back(CardAhead(-1));
  scene.meshes[0].double_sided = false;
  EXPECT_EQ(Pixel(Render(scene, TestCamera(160, 96)), 80, 50).x(), 255);
  std::swap(scene.meshes[0].indices[0], scene.meshes[0].indices[1]);
  std::swap(scene.meshes[0].indices[3], scene.meshes[0].indices[4]);
  EXPECT_EQ(Pixel(Render(scene, TestCamera(160, 96)), 80, 50).x(), 0);
  scene.meshes[0].double_sided = true;
  EXPECT_EQ(Pixel(Render(scene, TestCamera(160, 96)), 80, 50).x(), 255);
}

TEST(SceneRenderer, TheSideTowardsTheSunIsLit) {
  Scene scene = DarkScene();
  scene.meshes.push_back(CardAhead(-1));
  scene.meshes[0].emission.setZero();
  scene.light.ambient.setConstant(0.2F);
  scene.light.diffuse.setConstant(0.6F);
  for (const float side : {-1.0F, 1.0F}) {
    scene.light.to_sun = side * Eigen::Vector3f::UnitX();
    const int seen = Pixel(Render(scene, TestCamera(160, 96)), 80, 50).x();
    EXPECT_EQ(seen, side < 0.0F ? 204 : 51);  // the camera looks along +x
  }
}

TEST(SceneRenderer, FogLeavesFivePercentAtItsVisibility) {
  Scene scene = DarkScene();
  scene.sky.color.setOnes();
  scene.meshes.push_back(CardAhead(-1));
  scene.meshes[0].emission.setZero();  // black
  RenderQuality quality;
  quality.fog_visibility_m = 10.0;
  EXPECT_NEAR(Pixel(Render(scene, TestCamera(160, 96), quality), 78, 50).x(), 0.95 * 255, 1.5);
}

// Four colours around, from +x on to the right (clockwise from above).
Scene SkyScene() {
  Scene scene = DarkScene();
  SceneTexture texture{"sky", 4, 1, false, {}};
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  scene.textures.push_back(texture);
  scene.sky.texture = 0;
  scene.sky.bottom_elevation_rad = -0.2;
  scene.sky.top_elevation_rad = 0.3;
  scene.sky.color = {0.2F, 0.4F, 0.6F};
  scene.sky.color_below = {0.6F, 0.4F, 0.2F};
  return scene;
}

TEST(SceneRenderer, SkyRunsToTheRightAndEndsAtItsElevations) {
  const Camera camera = TestCamera(160, 96);
  const RenderedView view = Render(SkyScene(), camera);
  const auto column = [&](double right_rad) {
    return static_cast<int>(
        std::lround(camera.pinhole.cx + camera.pinhole.fx * std::tan(right_rad)));
  };
  EXPECT_GT(Pixel(view, column(0.6), 50).x(), 180);   // red: from 0 to 90 degrees right
  EXPECT_GT(Pixel(view, column(-0.6), 50).y(), 180);  // white: the last quarter
  const auto row = [&](double up_rad) {
    return static_cast<int>(std::lround(camera.pinhole.cy - camera.pinhole.fy * std::tan(up_rad)));
  };
  const int middle = static_cast<int>(std::lround(camera.pinhole.cx));
  EXPECT_EQ(Pixel(view, middle, row(0.34)), Eigen::Vector3i(51, 102, 153));
  EXPECT_EQ(Pixel(view, middle, row(-0.24)), Eigen::Vector3i(153, 102, 51));
  EXPECT_NE(Pixel(view, middle, row(0.26)), Eigen::Vector3i(51, 102, 153));
  EXPECT_NE(Pixel(view, middle, row(-0.16)), Eigen::Vector3i(153, 102, 51));
}

TEST(SceneRenderer, SkyIsInfinitelyFar) {
  const Camera camera = TestCamera(64, 48);
  const RenderedView here = Render(SkyScene(), camera);
  const RenderedView there = Render(SkyScene(), camera, {}, {500.0, -300.0, 80.0});
  EXPECT_TRUE(here.rgb == there.rgb);
}

TEST(SceneRenderer, RefusesBadInput) {
  const Camera camera = TestCamera(64, 48);
  RenderQuality quality;
  quality.supersampling = 0;
  EXPECT_THAT([&] { SceneRenderer(DarkScene(), camera, quality); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("supersampling")));
  Scene scene = DarkScene();
  scene.meshes.push_back(CardAhead(3));
  EXPECT_THAT([&] { SceneRenderer(scene, camera, {}); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("texture 3")));
  EXPECT_THAT([&] { SceneRenderer(DarkScene(), TestCamera(12000, 48), {}); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("24001 x 97")));
}

}  // namespace
}  // namespace lift_slam
