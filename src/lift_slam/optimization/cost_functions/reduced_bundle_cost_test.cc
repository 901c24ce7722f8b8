#include "lift_slam/optimization/cost_functions/reduced_bundle_cost.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "lift_slam/optimization/test_scene.h"

namespace lift_slam {
namespace {

// Two fixed and two free cameras, each point seen by all four.
class ReducedBundleCostTest : public testing::Test {
 protected:
  ReducedBundleCostTest() {
    Random random(21);
    const BundleScene scene = MakeBundleScene({.num_free_cameras = 2,
                                               .num_fixed_cameras = 2,
                                               .num_points = 60,
                                               .observations_per_point = 4,
                                               .sigma_px = 1.0},
                                              random);
    options_ = {scene.problem.intrinsics, 4.0, std::numeric_limits<double>::infinity()};
    for (const Rigid3d& pose : scene.problem.cams_from_world) cameras_.emplace_back(pose);
    for (const BundleObservation& o : scene.problem.observations) {
      if (NumObservations(scene.problem, o.point) < 4) continue;
      const int position = static_cast<int>(observations_.size());
      if (ranges_.empty() || ranges_.back().point != static_cast<int>(points_.size()) - 1 ||
          ranges_.back().end - ranges_.back().begin == 4) {
        ranges_.push_back({static_cast<int>(points_.size()), position, position});
        points_.push_back(scene.problem.points[static_cast<std::size_t>(o.point)]);
      }
      const int free_camera = o.camera >= 2 ? o.camera - 2 : -1;
      observations_.push_back(
          {o.camera, free_camera, o.pixel.x(), o.pixel.y(), 0.5 + 0.1 * o.camera});
      ranges_.back().end = position + 1;
    }
    parameters_ << 0.01, -0.3, 0.02, 0.1, -0.05, 0.1, -0.02, 0.2, 0.01, -0.1, 0.02, 0.05;
  }

  static int NumObservations(const BundleProblem& problem, int point) {
    return static_cast<int>(
        std::count_if(problem.observations.begin(), problem.observations.end(),
                      [&](const BundleObservation& o) { return o.point == point; }));
  }

  // Residuals times sqrt(rho' weight), by their definition, at poses and points changed by
  // [parameters of the free cameras (12), points (3 each)].
  Eigen::VectorXd Residuals(const Eigen::VectorXd& change, const Eigen::VectorXd* slopes) {
    Eigen::VectorXd residuals(2 * static_cast<Eigen::Index>(observations_.size()));
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const ReducedObservation& o = observations_[i];
      Rigid3d pose = cameras_[static_cast<std::size_t>(o.camera)].CamFromWorld();
      if (o.free_camera >= 0) {
        CameraBlock block(bases_[static_cast<std::size_t>(o.free_camera)]);
        Eigen::Map<Eigen::Matrix<double, 6, 1>>(block.parameters()) =
            change.segment<6>(6 * o.free_camera);
        pose = block.CamFromWorld();
      }
      const int point = PointOf(static_cast<int>(i));
      const Eigen::Vector3d x =
          points_[static_cast<std::size_t>(point)] + change.segment<3>(12 + 3 * point);
      const Eigen::Vector2d error =
          options_.intrinsics.Project(pose * x) - Eigen::Vector2d(o.u, o.v);
      const auto row = 2 * static_cast<Eigen::Index>(i);
      const double scale = slopes == nullptr ? 1.0 : std::sqrt((*slopes)[row / 2]);
      residuals.segment<2>(row) = scale * std::sqrt(o.weight) * error;
    }
    return residuals;
  }

  int PointOf(int observation) const {
    for (const ReducedPoint& range : ranges_) {
      if (observation < range.end) return range.point;
    }
    return -1;
  }

  ReducedBundleOptions options_;
  std::vector<CameraBlock> cameras_;
  std::vector<Rigid3d> bases_;
  std::vector<int> free_cameras_ = {2, 3};
  std::vector<Eigen::Vector3d> points_;
  std::vector<ReducedObservation> observations_;
  std::vector<ReducedPoint> ranges_;
  Eigen::VectorXd parameters_{12};
};

TEST_F(ReducedBundleCostTest, NormalEquationsAreTheSchurComplementOfNumericJacobians) {
  bases_ = {cameras_[2].CamFromWorld(), cameras_[3].CamFromWorld()};
  const ReducedBundleCost cost(options_, cameras_, free_cameras_, observations_, ranges_, points_);
  cost.Accept(parameters_);
  const NormalEquations<Eigen::Dynamic> found = cost.Linearize();

  Eigen::VectorXd change =
      Eigen::VectorXd::Zero(12 + 3 * static_cast<Eigen::Index>(points_.size()));
  change.head<12>() = parameters_;
  const Eigen::VectorXd plain = Residuals(change, nullptr);
  Eigen::VectorXd slopes(plain.size() / 2);
  double squared_norm = 0.0;
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const double e = plain.segment<2>(2 * i).squaredNorm();
    slopes[i] = e <= 16.0 ? 1.0 : 4.0 / std::sqrt(e);
    squared_norm += e <= 16.0 ? e : 8.0 * std::sqrt(e) - 16.0;
  }
  const Eigen::VectorXd residuals = Residuals(change, &slopes);
  Eigen::MatrixXd jacobian(residuals.size(), change.size());
  for (Eigen::Index k = 0; k < change.size(); ++k) {
    const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(change.size(), k);
    jacobian.col(k) =
        (Residuals(change + step, &slopes) - Residuals(change - step, &slopes)) / 2e-6;
  }
  const Eigen::MatrixXd hessian = jacobian.transpose() * jacobian;
  const Eigen::VectorXd gradient = jacobian.transpose() * residuals;
  const Eigen::Index rest = change.size() - 12;
  const Eigen::LLT<Eigen::MatrixXd> points(hessian.bottomRightCorner(rest, rest));
  const Eigen::MatrixXd schur =
      hessian.topLeftCorner(12, 12) -
      hessian.topRightCorner(12, rest) * points.solve(hessian.bottomLeftCorner(rest, 12));
  const Eigen::VectorXd reduced =
      gradient.head(12) - hessian.topRightCorner(12, rest) * points.solve(gradient.tail(rest));

  EXPECT_NEAR(found.squared_norm, squared_norm, 1e-9 * squared_norm);
  EXPECT_LT((found.hessian - schur).norm(), 1e-4 * schur.norm());
  EXPECT_LT((found.gradient - reduced).norm(), 1e-4 * reduced.norm());
}

TEST_F(ReducedBundleCostTest, TrialMovesPointsOnlyWhenItIsAccepted) {
  const std::vector<Eigen::Vector3d> before = points_;
  const ReducedBundleCost cost(options_, cameras_, free_cameras_, observations_, ranges_, points_);
  Eigen::VectorXd residuals(13);
  Eigen::MatrixXd jacobian(13, 12);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(12), trial = 0.01 * parameters_;
  cost(start.data(), residuals.data(), jacobian.data());
  cost(trial.data(), residuals.data(), nullptr);
  EXPECT_EQ(points_, before);
  const double trial_norm = residuals.squaredNorm();
  cost(start.data(), residuals.data(), jacobian.data());  // the trial was refused
  EXPECT_EQ(points_, before);
  cost(trial.data(), residuals.data(), nullptr);
  cost(trial.data(), residuals.data(), jacobian.data());
  EXPECT_NE(points_, before);
  EXPECT_NEAR(residuals.squaredNorm(), trial_norm, 1e-9 * trial_norm);
}

TEST_F(ReducedBundleCostTest, PointBehindAllCamerasStays) {
  points_[0] = {0.0, 0.0, -20.0};
  const ReducedBundleCost cost(options_, cameras_, free_cameras_, observations_, ranges_, points_);
  Eigen::VectorXd residuals(13);
  Eigen::MatrixXd jacobian(13, 12);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(12);
  cost(start.data(), residuals.data(), jacobian.data());
  EXPECT_TRUE(jacobian.allFinite());
  EXPECT_GT(residuals.squaredNorm(), 4 * (2 * 4.0 * std::sqrt(kBehindSquaredError) - 16.0));
  cost(start.data(), residuals.data(), nullptr);
  cost.Accept(start);
  EXPECT_EQ(points_[0], Eigen::Vector3d(0.0, 0.0, -20.0));
}

}  // namespace
}  // namespace lift_slam
