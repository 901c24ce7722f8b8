#include "lift_slam/simulation/render_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/simulation/sequence_folder.h"
#include "lift_slam/simulation/test_views.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RenderSequenceTest : public ::testing::Test {
 protected:
  SequenceRequest Request() const {
    SequenceRequest request{motion_,
                            FrameTimesNs(2.0, 10.0),
                            TestCamera(),
                            {},
                            {},
                            {},
                            {Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 12)},
                            1};
    request.sensor.noise.full_well_electrons = 2000.0;
    request.outputs.color = request.outputs.depth = true;
    return request;
  }

  RenderWork Work(int num_threads = 2) {
    RenderWork work;
    work.num_threads = num_threads;
    work.make_view_source = [this] {
      ++num_sources_;
      return [this](const Rigid3d& cam_from_world) {
        ++num_views_;
        return WallView(cam_from_world);
      };
    };
    return work;
  }

  // Every file's content by its path below the root.
  static std::map<std::string, std::string> AllFiles(const fs::path& root) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (entry.is_regular_file()) {
        files[fs::relative(entry.path(), root).string()] = ReadText(entry.path());
      }
    }
    return files;
  }

  TemporaryFolder folder_;
  const fs::path root_ = folder_ / "sequence";
  StraightMotion motion_;
  std::atomic<int> num_sources_ = 0, num_views_ = 0;
};

TEST_F(RenderSequenceTest, IsOpenedByOurOwnReader) {
  const RenderSummary summary = RenderSequence(root_, Request(), Work());
  EXPECT_EQ(summary.num_frames, 21);
  EXPECT_EQ(summary.num_rendered, 21);
  EXPECT_FALSE(summary.stopped);
  const auto sequence = OpenSequence(SequenceFolder(root_).Sequence().string(), {});
  EXPECT_EQ(sequence->info().num_frames, 21);
  EXPECT_EQ(sequence->info().camera->pinhole.fx, 40.0);
  EXPECT_TRUE(sequence->info().warnings.empty());
  ASSERT_TRUE(sequence->info().ground_truth);
  const Trajectory& truth = sequence->info().ground_truth->poses;
  ASSERT_EQ(truth.size(), 21U);
  for (int i = 0; i < 21; ++i) {
    const auto frame = sequence->Next();
    ASSERT_TRUE(frame && frame->image);
    EXPECT_EQ(frame->timestamp_ns, i * 100000000LL);
    EXPECT_NEAR(truth[static_cast<std::size_t>(i)].world_from_cam.translation.z(), 0.1 * i, 1e-9);
  }
}

TEST_F(RenderSequenceTest, TheSameBytesWhateverTheThreads) {
  RenderSequence(root_ / "one", Request(), Work(1));
  RenderSequence(root_ / "three", Request(), Work(3));
  EXPECT_EQ(AllFiles(root_ / "one"), AllFiles(root_ / "three"));
  EXPECT_EQ(AllFiles(root_ / "one").size(), 21U * 3 + 4);
}

TEST_F(RenderSequenceTest, GoesOnWhereItWasStopped) {
  RenderSequence(root_ / "whole", Request(), Work());
  RenderWork stopping = Work(1);
  int asked = 0;
  stopping.stop = [&] { return ++asked > 8; };
  const RenderSummary part = RenderSequence(root_ / "parts", Request(), stopping);
  EXPECT_TRUE(part.stopped);
  EXPECT_EQ(part.num_frames, 8);
  num_views_ = 0;
  const RenderSummary rest = RenderSequence(root_ / "parts", Request(), Work());
  EXPECT_EQ(rest.num_frames, 21);
  EXPECT_EQ(rest.num_rendered, 13);
  EXPECT_EQ(num_views_, 13);
  EXPECT_EQ(AllFiles(root_ / "whole"), AllFiles(root_ / "parts"));
}

TEST_F(RenderSequenceTest, RendersAnewWhatIsMissingOrCutShort) {
  RenderSequence(root_, Request(), Work());
  const SequenceFolder folder(root_);
  const std::string whole = ReadText(folder.Gray(4));
  WriteTextAtomically(folder.Gray(4), whole.substr(0, whole.size() - 20));
  fs::remove(folder.Depth(7, DepthFormat::kPng16));
  EXPECT_EQ(RenderSequence(root_, Request(), Work()).num_rendered, 2);
  EXPECT_EQ(ReadText(folder.Gray(4)), whole);
}

TEST_F(RenderSequenceTest, AFinishedSequenceNeedsNoRenderer) {
  RenderSequence(root_, Request(), Work());
  num_sources_ = 0;
  EXPECT_EQ(RenderSequence(root_, Request(), Work()).num_rendered, 0);
  EXPECT_EQ(num_sources_, 0);
}

TEST_F(RenderSequenceTest, WritesAbsolutePosesAndDepth) {
  SequenceRequest request = Request();
  request.times_ns.erase(request.times_ns.begin(), request.times_ns.begin() + 5);
  RenderSequence(root_, request, Work());
  const SequenceFolder folder(root_);
  const Trajectory scene = ReadTrajectory(folder.SceneTrajectory()).trajectory;
  ASSERT_EQ(scene.size(), 16U);
  EXPECT_EQ(scene[0].timestamp_ns, 0);
  EXPECT_NEAR(scene[0].world_from_cam.translation.z(), 0.5, 1e-9);
  EXPECT_NEAR(ReadDepth(folder.Depth(0, DepthFormat::kPng16)).depth_m[100], 9.5, 0.002);
}

TEST_F(RenderSequenceTest, ListsPairsWhenAsked) {
  SequenceRequest request = Request();
  RenderSequence(root_, request, Work());
  EXPECT_FALSE(fs::exists(SequenceFolder(root_).Pairs()));
  request.outputs.pairs = true;
  RenderSequence(root_, request, Work());
  EXPECT_THAT(ReadText(SequenceFolder(root_).Pairs()), HasSubstr("\n0 1 0.1000 0.000 "));
}

TEST_F(RenderSequenceTest, DistortionGoesToNoCalibTxt) {
  SequenceRequest request = Request();
  request.camera.distortion = RadialTangential{0.1, 0.0, 0.0, 0.0, 0.0};
  RenderSequence(root_, request, Work());
  EXPECT_FALSE(fs::exists(SequenceFolder(root_).Sequence() / "calib.txt"));
}

TEST_F(RenderSequenceTest, RefusesAPathThatLeavesTheScene) {
  SequenceRequest request = Request();
  request.scene_box.max().z() = 1.05;
  try {
    RenderSequence(root_, request, Work());
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 11 is at (0.0, 0.0, 1.1) m"));
  }
  EXPECT_FALSE(fs::exists(root_));
}

TEST_F(RenderSequenceTest, RefusesNothingButSky) {
  RenderWork work = Work();
  work.make_view_source = [] { return SkyView; };
  try {
    RenderSequence(root_, Request(), work);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("from frame 0 at"));
  }
}

TEST(FrameTimesNs, CountsBothEnds) {
  EXPECT_EQ(FrameTimesNs(2.0, 10.0).size(), 21U);
  EXPECT_EQ(FrameTimesNs(1.99, 10.0).size(), 20U);
  EXPECT_EQ(FrameTimesNs(0.0, 10.0), std::vector<std::int64_t>{0});
  EXPECT_EQ(FrameTimesNs(1.0, 30.0)[1], 33333333);
}

TEST(SequenceOutputOptions, PairsNeedDepth) {
  SequenceOutputOptions options;
  options.pairs = true;
  EXPECT_THROW(options.Check(), InputError);
}

}  // namespace
}  // namespace lift_slam
