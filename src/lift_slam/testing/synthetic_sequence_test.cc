#include "lift_slam/testing/synthetic_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/testing/rigid3_matchers.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

SyntheticSequenceOptions SmallOptions(SyntheticPath path) {
  SyntheticSequenceOptions options;
  options.path = path;
  options.camera.pinhole = {250.0, 250.0, 159.5, 119.5, 320, 240};
  options.num_frames = 3;
  return options;
}

double MeanDifference(const GrayImage& a, const GrayImage& b) {
  double sum = 0.0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) sum += std::abs(a.row(y)[x] - b.row(y)[x]);
  }
  return sum / (a.width() * a.height());
}

double StandardDeviation(const GrayImage& image) {
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      sum += image.row(y)[x];
      squares += static_cast<double>(image.row(y)[x]) * image.row(y)[x];
    }
  }
  const double count = image.width() * image.height();
  return std::sqrt(squares / count - sum / count * sum / count);
}

// A fresh folder below the test's temporary folder, removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(fs::path(testing::TempDir()) / ("lift_slam_" + name)) {
    fs::remove_all(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(SyntheticSequence, FramesAreTheSameBytesInAnyOrder) {
  const SyntheticSequence a(SmallOptions(SyntheticPath::kRoomSway));
  const SyntheticSequence b(SmallOptions(SyntheticPath::kRoomSway));
  const GrayImage second = a.Render(2);
  b.Render(0);
  EXPECT_EQ(MeanDifference(second, b.Render(2)), 0.0);
  auto other = SmallOptions(SyntheticPath::kRoomSway);
  other.seed = 2;
  EXPECT_GT(MeanDifference(second, SyntheticSequence(other).Render(2)), 10.0);
}

TEST(SyntheticSequence, EveryWorldHasContrast) {
  for (const SyntheticPath path : {SyntheticPath::kStreetDrive, SyntheticPath::kRoomLoop}) {
    EXPECT_GT(StandardDeviation(SyntheticSequence(SmallOptions(path)).Render(0)), 25.0)
        << Name(path);
  }
}

TEST(SyntheticSequence, ExposureScalesTheImage) {
  auto options = SmallOptions(SyntheticPath::kRoomStill);
  options.noise_gray = 0.0;
  options.frame_rate_hz = 0.8;  // frame 1 at a quarter of the swing's period of 5 s
  const SyntheticSequence plain(options);
  options.exposure_change = 0.3;
  const SyntheticSequence changing(options);
  const double dark = plain.Render(1).row(120)[160];
  EXPECT_NEAR(changing.Render(1).row(120)[160], std::min(1.3 * dark, 255.0), 1.5);
}

TEST(CameraPath, StillStaysAndRotationOnlyTurns) {
  const Rigid3d start = WorldFromCamOnPath(SyntheticPath::kRoomStill, 0.0);
  EXPECT_THAT(WorldFromCamOnPath(SyntheticPath::kRoomStill, 7.0), Rigid3dNear(start, 0.0, 0.0));
  const Rigid3d a = WorldFromCamOnPath(SyntheticPath::kRoomRotation, 0.0);
  const Rigid3d b = WorldFromCamOnPath(SyntheticPath::kRoomRotation, 1.0);
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_GT(RotationAngle(a.rotation * b.rotation.conjugate()), 0.2);
}

TEST(CameraPath, LoopCloses) {
  const Rigid3d start = WorldFromCamOnPath(SyntheticPath::kRoomLoop, 0.0);
  EXPECT_THAT(WorldFromCamOnPath(SyntheticPath::kRoomLoop, 20.0), Rigid3dNear(start, 1e-6, 1e-9));
  EXPECT_THAT(WorldFromCamOnPath(SyntheticPath::kRoomLoop, 10.0),
              testing::Not(Rigid3dNear(start, 90.0, 3.0)));
}

TEST(CameraPath, DriveGoesForwardAtConstantSpeedWithCurves) {
  double largest_turn = 0.0;
  for (double t = 0.0; t < 40.0; t += 0.1) {
    const Rigid3d now = WorldFromCamOnPath(SyntheticPath::kStreetDrive, t);
    const Rigid3d next = WorldFromCamOnPath(SyntheticPath::kStreetDrive, t + 0.1);
    const Eigen::Vector3d step = Inverse(now) * next.translation;
    EXPECT_NEAR(step.norm(), 0.8, 0.01);
    EXPECT_LT(AngleBetween(step, Eigen::Vector3d::UnitZ()), 0.05);
    largest_turn = std::max(largest_turn, RotationAngle(now.rotation * next.rotation.conjugate()));
  }
  EXPECT_GT(largest_turn, 0.01);
}

// A wall 4 m ahead with a single texture: what one camera sees at a pixel the other must see at
// the projection of the same wall point.
TEST(Renderer, AgreesWithTheProjectionOfTheWorld) {
  TexturedWorld world;
  world.textures.push_back(MakeTexture(TextureKind::kClutter, 5));
  world.quads.push_back({{-8, -8, 4}, {16, 0, 0}, {0, 16, 0}, 0, 40.0});
  const Camera camera = SyntheticCamera();
  const Renderer renderer(camera);
  PictureOptions options;
  options.noise_gray = 0.0;
  const Rigid3d cam2(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())),
                     {0.3, -0.1, 0.2});
  const GrayImage image1 = renderer.Render(world, Rigid3d(), options);
  const GrayImage image2 = renderer.Render(world, cam2, options);
  double difference = 0.0;
  int count = 0;
  for (int y = 40; y < 440; y += 3) {
    for (int x = 40; x < 600; x += 3) {
      const Eigen::Vector3d point = 4.0 * camera.pinhole.Unproject(Eigen::Vector2d(x, y));
      const Eigen::Vector2d pixel = camera.pinhole.Project(cam2 * point);
      if (pixel.minCoeff() < 0.0 || pixel.x() > 638.0 || pixel.y() > 478.0) continue;
      const int x2 = static_cast<int>(pixel.x()), y2 = static_cast<int>(pixel.y());
      const double wx = pixel.x() - x2, wy = pixel.y() - y2;
      const auto* top = image2.row(y2) + x2;
      const auto* bottom = image2.row(y2 + 1) + x2;
      const double seen = (1 - wy) * ((1 - wx) * top[0] + wx * top[1]) +
                          wy * ((1 - wx) * bottom[0] + wx * bottom[1]);
      difference += std::abs(seen - image1.row(y)[x]);
      ++count;
    }
  }
  ASSERT_GT(count, 10000);
  EXPECT_LT(difference / count, 3.0);  // half a pixel off gives about 10
}

TEST(Renderer, DistortedImageIsThePinholeImageMoved) {
  auto options = SmallOptions(SyntheticPath::kRoomSway);
  options.noise_gray = 0.0;
  const GrayImage ideal = SyntheticSequence(options).Render(0);
  options.camera.distortion = RadialTangential{-0.2, 0.05, 0.0, 0.0, 0.0};
  const GrayImage distorted = SyntheticSequence(options).Render(0);
  double difference = 0.0;
  int count = 0;
  for (int y = 10; y < 230; y += 2) {
    for (int x = 10; x < 310; x += 2) {
      const auto pixel = options.camera.Undistort(Eigen::Vector2d(x, y));
      if (!pixel || pixel->minCoeff() < 0.0 || pixel->x() > 319.0 || pixel->y() > 239.0) continue;
      const auto* row = ideal.row(static_cast<int>(std::lround(pixel->y())));
      difference += std::abs(distorted.row(y)[x] - row[std::lround(pixel->x())]);
      ++count;
    }
  }
  ASSERT_GT(count, 10000);
  EXPECT_LT(difference / count, 0.4 * MeanDifference(ideal, distorted));
}

TEST(Renderer, NearerQuadHidesFartherOne) {
  TexturedWorld world;
  world.textures.emplace_back(1, std::vector<float>{50.0F});
  world.textures.emplace_back(1, std::vector<float>{200.0F});
  world.quads.push_back({{-9, -9, 2}, {9, 0, 0}, {0, 18, 0}, 0, 1.0});  // near, left half
  world.quads.push_back({{-9, -9, 5}, {18, 0, 0}, {0, 18, 0}, 1, 1.0});
  PictureOptions options;
  options.noise_gray = 0.0;
  const GrayImage image = Renderer(SyntheticCamera()).Render(world, Rigid3d(), options);
  EXPECT_EQ(image.row(240)[100], 50);
  EXPECT_EQ(image.row(240)[500], 200);
}

TEST(SequenceWriter, KittiLayout) {
  const TemporaryFolder folder("kitti");
  const auto options = SmallOptions(SyntheticPath::kStreetDrive);
  const auto written =
      WriteSyntheticSequence(folder.path(), SequenceLayout::kKittiOdometry, options);
  EXPECT_EQ(written.folder, folder.path() / "sequences" / "00");
  EXPECT_EQ(ReadLines(written.folder / "times.txt").size(), 3U);
  EXPECT_EQ(ReadText(written.folder / "calib.txt").substr(0, 4), "P0: ");
  const auto poses = ReadLines(written.ground_truth);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].substr(0, 18), "1.000000000000e+00");
  std::string why;
  const auto image = ReadGrayImage(written.folder / "image_0" / "000002.png", &why);
  ASSERT_TRUE(image) << why;
  EXPECT_EQ(MeanDifference(*image, SyntheticSequence(options).Render(2)), 0.0);
}

TEST(SequenceWriter, TumLayout) {
  const TemporaryFolder folder("tum");
  auto options = SmallOptions(SyntheticPath::kRoomSway);
  options.camera.distortion = RadialTangential{-0.1, 0.01, 0.001, 0.0, 0.0};
  const auto written = WriteSyntheticSequence(folder.path(), SequenceLayout::kTumRgbd, options);
  const auto images = ReadLines(folder.path() / "rgb.txt");
  ASSERT_EQ(images.size(), 5U);
  EXPECT_EQ(images[3], "0.033333333 rgb/0.033333333.png");
  EXPECT_TRUE(fs::exists(folder.path() / "rgb" / "0.033333333.png"));
  EXPECT_EQ(ReadLines(written.ground_truth).size(), 5U);
  EXPECT_NE(ReadText(folder.path() / "camera.yaml").find("Camera.k1: -0.1\n"), std::string::npos);
}

TEST(SequenceWriter, EurocLayoutKeepsNanosecondsAndTheLeverArm) {
  const TemporaryFolder folder("euroc");
  const auto options = SmallOptions(SyntheticPath::kRoomLoop);
  const auto written = WriteSyntheticSequence(folder.path(), SequenceLayout::kEuroc, options);
  const auto images = ReadLines(folder.path() / "mav0" / "cam0" / "data.csv");
  ASSERT_EQ(images.size(), 4U);
  EXPECT_EQ(images[1], "1403636579763555584,1403636579763555584.png");
  const auto poses = ReadLines(written.ground_truth);
  ASSERT_EQ(poses.size(), 4U);
  double x = 0.0, y = 0.0, z = 0.0;
  ASSERT_EQ(std::sscanf(poses[1].c_str(), "%*d,%lf,%lf,%lf", &x, &y, &z), 3);
  const Eigen::Vector3d camera = WorldFromCamOnPath(SyntheticPath::kRoomLoop, 0.0).translation;
  EXPECT_NEAR((Eigen::Vector3d(x, y, z) - camera).norm(), 0.0689, 0.001);
}

TEST(SequenceWriter, RefusesWhatALayoutCannotHold) {
  const TemporaryFolder folder("refused");
  auto options = SmallOptions(SyntheticPath::kRoomSway);
  options.camera.distortion = KannalaBrandt{0.01, 0.0, 0.0, 0.0};
  for (const auto layout :
       {SequenceLayout::kKittiOdometry, SequenceLayout::kTumRgbd, SequenceLayout::kEuroc}) {
    EXPECT_THROW(WriteSyntheticSequence(folder.path(), layout, options), InputError);
  }
  options = SmallOptions(SyntheticPath::kRoomSway);
  EXPECT_THROW(WriteSyntheticSequence("/proc/no_such_place", SequenceLayout::kEuroc, options),
               InputError);
}

}  // namespace
}  // namespace lift_slam
