// Against numbers that others published for recorded trajectories.

#include <gtest/gtest.h>

#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/test_data.h"
#include "lift_slam/geometry/trajectory_io.h"

namespace lift_slam {
namespace {

constexpr double kToleranceM = 1e-6;

struct Published {
  double rmse, mean, median, std, min, max;
};

void ExpectNear(const ErrorStatistics& actual, const Published& expected) {
  EXPECT_NEAR(actual.rmse, expected.rmse, kToleranceM);
  EXPECT_NEAR(actual.mean, expected.mean, kToleranceM);
  EXPECT_NEAR(actual.median, expected.median, kToleranceM);
  EXPECT_NEAR(actual.std, expected.std, kToleranceM);
  EXPECT_NEAR(actual.min, expected.min, kToleranceM);
  EXPECT_NEAR(actual.max, expected.max, kToleranceM);
}

EvaluationResult EvaluateFiles(const std::filesystem::path& estimate,
                               const std::filesystem::path& reference, EvaluationOptions options) {
  options.estimate_lists_every_frame = false;
  return Evaluate(ReadTrajectory(estimate).trajectory, ReadTrajectory(reference).trajectory,
                  options);
}

class Kitti00 : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = test::FindData("evo_trajectories");
    if (!folder) GTEST_SKIP() << "set LIFT_SLAM_DATA to the folder of the recorded data";
    folder_ = *folder;
  }

  ErrorStatistics AteSe3(const std::string& estimate) const {
    EvaluationOptions options;
    options.alignment = AlignmentMode::kSe3;
    return *EvaluateFiles(folder_ / estimate, folder_ / "KITTI_00_gt.txt", options).ate_m;
  }

  // Consecutive pairs of 10 m along the estimate, not aligned.
  ErrorStatistics RpeTenMetres(const std::string& estimate) const {
    EvaluationOptions options;
    options.alignment = AlignmentMode::kNone;
    options.rpe = {.delta = 10.0,
                   .unit = RpeUnit::kMetres,
                   .pairs = RpePairs::kConsecutive,
                   .path_source = RpePathSource::kEstimate};
    return EvaluateFiles(folder_ / estimate, folder_ / "KITTI_00_gt.txt", options)
        .rpe->translation_m;
  }

  std::filesystem::path folder_;
};

TEST_F(Kitti00, AteOfOrbSlamIsThePublishedOne) {
  ExpectNear(AteSe3("KITTI_00_ORB.txt"),
             {1.3034497145650266, 1.1569971285389768, 1.065624769555848, 0.6002822693968323,
              0.06931322021483087, 3.587949120678954});
}

TEST_F(Kitti00, AteOfSptamIsThePublishedOne) {
  ExpectNear(AteSe3("KITTI_00_SPTAM.txt"),
             {3.738487907582613, 3.4909766330848684, 3.6425846417432637, 1.3376748418045645,
              0.694787347406252, 7.7689774065713175});
}

TEST_F(Kitti00, RpeOfOrbSlamIsThePublishedOne) {
  ExpectNear(RpeTenMetres("KITTI_00_ORB.txt"),
             {0.22626134329310163, 0.16901737200653275, 0.13848432516645606, 0.1504238127053164,
              0.025322719660754993, 1.2722090778658726});
}

TEST_F(Kitti00, RpeOfSptamIsThePublishedOne) {
  ExpectNear(RpeTenMetres("KITTI_00_SPTAM.txt"),
             {0.27607109043606004, 0.22284797909537604, 0.1783338691210611, 0.16295405851853487,
              0.01875232105572263, 1.2065944255781629});
}

// The benchmark's formula, computed apart from this code from the matrices as they are stored.
TEST_F(Kitti00, RelativeErrorIsThatOfTheBenchmark) {
  struct {
    const char* estimate;
    double t_rel_pct, r_rel_deg_per_m;
  } const expected[] = {{"KITTI_00_ORB.txt", 0.6997289, 0.0025356},
                        {"KITTI_00_SPTAM.txt", 1.4869597, 0.0055775}};
  for (const auto& [estimate, t_rel_pct, r_rel_deg_per_m] : expected) {
    EvaluationOptions options;
    options.alignment = AlignmentMode::kSe3;
    const KittiError error =
        *EvaluateFiles(folder_ / estimate, folder_ / "KITTI_00_gt.txt", options).kitti;
    EXPECT_EQ(error.all.num_segments, 3283);
    EXPECT_NEAR(error.all.translation_pct, t_rel_pct, 1e-5);
    // acos of the stored trace, six digits in the files, loses digits that the angle keeps.
    EXPECT_NEAR(error.all.rotation_deg_per_m, r_rel_deg_per_m, 5e-6);
  }
}

// ATE in cm of the perfect camera trajectory against the body positions: the lever arm alone.
struct LeverArm {
  const char* sequence;
  double se3_cm, sim3_cm;
};

class EurocLeverArm : public testing::TestWithParam<LeverArm> {};

TEST_P(EurocLeverArm, BodyPositionsCostWhatTheTableSays) {
  const auto file =
      test::FindData(std::string("euroc/groundtruth_cam0_tum/") + GetParam().sequence + ".txt");
  if (!file) GTEST_SKIP() << "set LIFT_SLAM_DATA to the folder of the recorded data";
  // T_BS of cam0/sensor.yaml, the same in all sequences.
  const Rigid3d body_from_cam(
      (Eigen::Matrix3d() << 0.0148655429818, -0.999880929698, 0.00414029679422, 0.999557249008,
       0.0149672133247, 0.025715529948, -0.0257744366974, 0.00375618835797, 0.999660727178)
          .finished(),
      Eigen::Vector3d(-0.0216401454975, -0.064676986768, 0.00981073058949));
  const Trajectory camera = ReadTrajectory(*file).trajectory;
  const Trajectory body = CameraFromBodyTrajectory(camera, Inverse(body_from_cam));
  EvaluationOptions options;
  options.gt_frame = GroundTruthFrame::kBody;
  options.association.max_time_difference_ms = kEurocMaxTimeDifferenceMs;
  EXPECT_NEAR(100.0 * Evaluate(camera, body, options).ate_m->rmse, GetParam().sim3_cm, 0.1);
  options.alignment = AlignmentMode::kSe3;
  EXPECT_NEAR(100.0 * Evaluate(camera, body, options).ate_m->rmse, GetParam().se3_cm, 0.1);
  const Trajectory camera_again = CameraFromBodyTrajectory(body, body_from_cam);
  EXPECT_LT(Evaluate(camera, camera_again, options).ate_m->rmse, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    AllSequences, EurocLeverArm,
    testing::Values(LeverArm{"MH_01_easy", 4.0, 3.6}, LeverArm{"MH_02_easy", 3.8, 3.1},
                    LeverArm{"MH_03_medium", 3.9, 3.7}, LeverArm{"MH_04_difficult", 3.2, 3.1},
                    LeverArm{"MH_05_difficult", 3.1, 3.1}, LeverArm{"V1_01_easy", 5.5, 5.5},
                    LeverArm{"V1_02_medium", 6.0, 6.0}, LeverArm{"V1_03_difficult", 5.6, 5.4},
                    LeverArm{"V2_01_easy", 5.8, 5.2}, LeverArm{"V2_02_medium", 5.5, 5.4},
                    LeverArm{"V2_03_difficult", 5.9, 5.9}),
    [](const auto& test) { return std::string(test.param.sequence); });

}  // namespace
}  // namespace lift_slam
