// SLAM with LIFT features.
#include <gtest/gtest.h>

#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/features/lift/lift_weights_import.h"
#include "lift_slam/slam/run_for_test.h"
#include "lift_slam/testing/real_data.h"
#include "lift_slam/testing/temporary_folder.h"

namespace lift_slam {
namespace {

class LiftRun : public testing::Test {
 protected:
  // Weights that nobody trained. Their distances mean nothing, so that every nearest one is tried.
  TestRunOptions Untrained() const {
    LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 5, /*with_orientation=*/false);
    WriteLiftWeights(weights, folder_ / "untrained.safetensors");
    TestRunOptions options;
    options.slam.features.type = FeatureType::kLift;
    options.slam.features.lift_weights = (folder_ / "untrained.safetensors").string();
    options.slam.features.lift.upright = true;
    options.slam.features.lift.max_features = 600;
    options.slam.features.lift.low_threshold = options.slam.features.lift.high_threshold = 1e6;
    options.slam.matching.thresholds = ThresholdMode::kFixed;
    return options;
  }

  TemporaryFolder folder_;
};

TEST_F(LiftRun, IsTheSameEveryTime) {
  const auto sequence = SmallSequence(SyntheticPath::kStreetDrive, 10, 10.0);
  TestRunOptions options = Untrained();
  const RunRecord run = RunSynthetic(sequence, options);
  EXPECT_GE(run.num_maps, 1);
  options.mode = RunMode::kThreaded;
  options.slam.features.lift.num_threads = 2;
  EXPECT_TRUE(SamePoses(run.final_trajectory, RunSynthetic(sequence, options).final_trajectory));
}

TEST_F(LiftRun, IsTheSameWithFeaturesFromACache) {
  const auto sequence = SmallSequence(SyntheticPath::kStreetDrive, 6, 10.0);
  FeatureOptions options = Untrained().slam.features;
  const auto cache = std::make_shared<FeatureCache>(folder_ / "cache");
  const auto extract = [&](std::shared_ptr<FeatureCache> from) {
    return CreateFeatureExtractor(options, std::move(from))
        ->Extract(SyntheticSequence(sequence).Render(3));
  };
  const FeatureSet made = extract(nullptr), kept = extract(cache);
  options.lift.sigma_px = 1.0;  // changes what a position weighs, not the features
  const FeatureSet found = extract(cache);
  EXPECT_EQ(cache->statistics().num_found, 1);
  ASSERT_EQ(found.keypoints.size(), made.keypoints.size());
  ASSERT_GT(found.keypoints.size(), 100U);
  for (std::size_t i = 0; i < made.keypoints.size(); ++i) {
    EXPECT_EQ(found.keypoints[i].x, made.keypoints[i].x);
    EXPECT_TRUE(std::ranges::equal(found.descriptors.row(i), made.descriptors.row(i)));
  }
  options.lift.max_features = 300;
  extract(cache);
  EXPECT_EQ(cache->statistics().num_made, 2);
}

TEST_F(LiftRun, AdaptiveThresholdsAreRecordedForEveryTrackedFrame) {
  TestRunOptions options = Untrained();
  options.slam.matching.thresholds = ThresholdMode::kAdaptive;
  options.slam.features.lift.low_threshold = options.slam.features.lift.high_threshold = 0.0;
  const RunRecord run = RunSynthetic(SmallSequence(SyntheticPath::kStreetDrive, 15, 10.0), options);
  int tracked = 0;
  for (const FrameRecord& frame : run.frames) {
    if (frame.num_last_matches == 0) continue;
    ++tracked;
    // The paper's bounds, as these weights come without measured distances.
    EXPECT_GE(frame.low_threshold, 1.0F);
    EXPECT_LE(frame.high_threshold, 3.0F);
    EXPECT_LE(frame.num_last_outliers, frame.num_last_matches);
  }
  EXPECT_GE(tracked, 5);
}

TEST_F(LiftRun, Kitti06WithTheAuthorsWeights) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  if (RealDataFolder().empty()) GTEST_SKIP() << "no real data: set LIFT_SLAM_DATA";
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "takes minutes in a debug build or under a sanitizer";
#endif
  const std::vector<std::filesystem::path> files = {LiftReferenceFolder() / "tf-lift-release.h5"};
  LiftWeights weights = ImportLiftWeights(files, {});
  WriteLiftWeights(weights, folder_ / "released.safetensors");
  TestRunOptions options;
  options.mode = RunMode::kThreaded;
  options.slam.features.type = FeatureType::kLift;
  options.slam.features.lift_weights = (folder_ / "released.safetensors").string();
  options.slam.features.lift.upright = true;
  SequenceOptions sequence_options;
  sequence_options.ground_truth_file = RealDataFolder() / "kitti/poses_cut/06.txt";
  auto sequence =
      OpenSequence((RealDataFolder() / "kitti/sequences/06").string(), sequence_options);
  const Trajectory truth = sequence->info().ground_truth->poses;
  const RunRecord run = RunSequence(std::move(sequence), options);
  EvaluationOptions evaluation;
  evaluation.association.method = AssociationMethod::kIndex;
  const EvaluationResult result = Evaluate(run.final_trajectory, truth, evaluation);
  EXPECT_GE(result.coverage.coverage, 0.95);
  ASSERT_TRUE(result.ate_m) << result.no_errors_reason;
  std::cout << "ATE " << result.ate_m->rmse << " m\n";
  EXPECT_LE(result.ate_m->rmse, 0.04);
}

}  // namespace
}  // namespace lift_slam
