#include "lift_slam/simulation/motion_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/motion/test_roads.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

Eigen::AlignedBox3d Box() { return {Eigen::Vector3d(-50, -50, 0), Eigen::Vector3d(300, 100, 20)}; }

MotionPlan Plan(const RenderOptions& options, const std::optional<Road>& road = OvalRoad()) {
  return PlanMotion(options, road, "it has none", Box());
}

std::string WhyRefused(const RenderOptions& options, const std::optional<Road>& road = OvalRoad()) {
  try {
    Plan(options, road);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr char kPoses[] = "5 1 0 0 0 0 0 1\n5.25 2 0 0 0 0 0 1\n6 4 0 0 0 0 0 1\n";

TEST(PlanMotion, DrivesWhereThereIsARoadElseWalks) {
  EXPECT_THAT(Plan({}).description, HasSubstr("drive of"));
  EXPECT_THAT(Plan({}, std::nullopt).description, HasSubstr("walk of"));
  RenderOptions options;
  options.scene = "forza";
  options.motion = MotionKind::kDrive;
  EXPECT_THAT(WhyRefused(options, std::nullopt), HasSubstr("forza: there is no road to drive on"));
}

TEST(PlanMotion, TakesFramesAtTheRateAndCutsOutARange) {
  RenderOptions options;
  options.camera.rate_hz = 20.0;
  EXPECT_EQ(Plan(options).times_ns[3], 150000000);
  options.frames = "10:20:5";
  EXPECT_EQ(Plan(options).times_ns, (std::vector<std::int64_t>{500000000, 750000000, 1000000000}));
  options.frames = ":2";
  EXPECT_EQ(Plan(options).times_ns.size(), 3U);
}

TEST(PlanMotion, RefusesRangesThatAreNone) {
  for (const char* range : {"5:2", "a", "1:2:3:4", "::0", "-1:"}) {
    RenderOptions options;
    options.frames = range;
    EXPECT_THAT(WhyRefused(options), HasSubstr("expected FIRST:LAST:STEP")) << range;
  }
  RenderOptions options;
  options.frames = "1000000:";
  EXPECT_THAT(WhyRefused(options), HasSubstr("selects none"));
}

TEST(PlanMotion, RecordedPosesAreFramesAtTheirTimes) {
  RenderOptions options;
  const TemporaryFolder folder;
  options.poses.file = folder.Write("poses.tum", kPoses).string();
  const MotionPlan plan = Plan(options);
  EXPECT_EQ(plan.times_ns, (std::vector<std::int64_t>{0, 250000000, 1000000000}));
  EXPECT_NEAR(plan.motion->WorldFromCam(0.25).translation.x(), 2.0, 1e-12);
}

TEST(PlanMotion, RecordedPosesCanBeginAtTheStart) {
  RenderOptions options;
  const Rigid3d start = Plan(options).motion->WorldFromCam(0.0);
  const TemporaryFolder folder;
  options.poses.file = folder.Write("poses.tum", kPoses).string();
  options.poses.from_start = true;
  options.poses.scale = 2.0;
  const MotionPlan plan = Plan(options);
  EXPECT_LT((plan.motion->WorldFromCam(0.0).translation - start.translation).norm(), 1e-9);
  EXPECT_NEAR((plan.motion->WorldFromCam(1.0).translation - start.translation).norm(), 6.0, 1e-9);
}

TEST(PlanMotion, RefusesPosesOfAnotherFileThanAsked) {
  RenderOptions options;
  const TemporaryFolder folder;
  options.poses.file = folder.Write("poses.tum", kPoses).string();
  options.poses.sha256 = std::string(64, '0');
  EXPECT_THAT(WhyRefused(options), HasSubstr("SHA-256"));
  options.poses.file.clear();
  options.motion = MotionKind::kPoses;
  EXPECT_THAT(WhyRefused(options), HasSubstr("poses.file"));
}

TEST(PlanMotion, ShakesAnyMotion) {
  RenderOptions options;
  const Eigen::Vector3d still = Plan(options).motion->WorldFromCam(3.0).translation;
  options.shake.translation_m = 0.01;
  const Eigen::Vector3d shaken = Plan(options).motion->WorldFromCam(3.0).translation;
  EXPECT_GT((shaken - still).norm(), 1e-5);
  EXPECT_LT((shaken - still).norm(), 0.1);
}

TEST(SceneBox, HoldsEveryVertexAndTheCameraHasRoom) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].vertices.resize(2);
  scene.meshes[0].vertices[0].position = {0, 0, 0};
  scene.meshes[0].vertices[1].position = {10, 20, 0};
  EXPECT_TRUE(SceneBox(scene).max() == Eigen::Vector3d(10, 20, 0));
  EXPECT_TRUE(RoomForCamera(SceneBox(scene)).contains(Eigen::Vector3d(5, 5, 1.65)));
  EXPECT_FALSE(RoomForCamera(SceneBox(scene)).contains(Eigen::Vector3d(5, 5, 5)));
}

}  // namespace
}  // namespace lift_slam
