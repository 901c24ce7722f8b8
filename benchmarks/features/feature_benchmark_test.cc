#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "benchmarks/features/image_sets.h"
#include "benchmarks/features/orientation_table.h"
#include "benchmarks/features/quality_tables.h"
#include "lift_slam/testing/temporary_folder.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

// KITTI 00 with 12 small images.
void WriteKitti(const TemporaryFolder& folder) {
  std::string calibration;
  for (int i = 0; i < 4; ++i) {
    calibration += fmt::format("P{}: 20 0 15.5 0 0 20 11.5 0 0 0 1 0\n", i);
  }
  folder.Write("kitti/sequences/00/calib.txt", calibration);
  std::filesystem::create_directories(folder / "kitti/sequences/00/image_0");
  for (int i = 0; i < 12; ++i) {
    cv::imwrite(folder / fmt::format("kitti/sequences/00/image_0/{:06}.png", i),
                cv::Mat(24, 32, CV_8UC1, cv::Scalar(10 * i)));
  }
}

TEST(RealImageSets, PassOverFilesThatAreNoImages) {
  const TemporaryFolder folder;
  WriteKitti(folder);
  for (const char* stray : {".DS_Store", "nan.png", "Thumbs.db"}) {
    folder.Write(std::string("kitti/sequences/00/image_0/") + stray, "");
  }
  const std::vector<ImageSet> sets = RealImageSets(folder.path(), 1);
  ASSERT_EQ(sets.size(), 6U);  // RedKitchen is missing
  EXPECT_EQ(sets[0].pairs[0].second.row(0)[0], 10);
  EXPECT_EQ(sets[1].pairs[0].second.row(0)[0], 50);
}

TEST(OneOfEachKind, LeavesOutTheSameImagesInAnotherLight) {
  const TemporaryFolder folder;
  WriteKitti(folder);
  std::vector<ImageSet> sets = RealImageSets(folder.path(), 1);
  ASSERT_GT(sets.size(), 1U);
  EXPECT_EQ(OneOfEachKind(sets).size(), 1U);
  const GrayImage other(cv::Mat(24, 32, CV_8UC1, cv::Scalar(1)));
  sets.push_back({"other", {}, 1.0, {{other, other}}});
  ASSERT_EQ(OneOfEachKind(sets).size(), 2U);
  EXPECT_EQ(OneOfEachKind(sets)[1].name, "other");
}

TEST(FeatureTables, HaveNoFiguresWithoutKeypoints) {
  const GrayImage flat(cv::Mat(200, 200, CV_8UC1, cv::Scalar(90)));
  const std::vector<ImageSet> sets{{"flat", {}, 1.0, {{flat, flat}}}};
  const std::vector<NamedWeights> weights{{"random", RandomLiftWeights(LiftTopology::kF, 3)}};
  EXPECT_THAT(DescriptorTable(weights, sets, {}), HasSubstr("| random upright float32 | - |"));
  EXPECT_THAT(OrientationTable(weights, sets, {}), HasSubstr("| random | - | - | - |"));
}

}  // namespace
}  // namespace lift_slam
