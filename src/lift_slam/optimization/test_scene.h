#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "lift_slam/optimization/pose_optimization.h"
#include "lift_slam/optimization/so3.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

// Synthetic observations for the tests and benchmarks of this folder.

// A KITTI-like camera.
inline PinholeIntrinsics TestIntrinsics() { return {718.0, 720.0, 607.0, 185.0, 1241, 376}; }

inline Eigen::Vector3d RandomVector(Random& random, double sigma) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

// `pose` turned by about sigma_rad and moved by about sigma_map_units in each axis of the camera.
inline Rigid3d Perturb(const Rigid3d& pose, Random& random, double sigma_rad,
                       double sigma_map_units) {
  const Eigen::Quaterniond turn = ExpSo3(RandomVector(random, sigma_rad));
  return {turn * pose.rotation, turn * pose.translation + RandomVector(random, sigma_map_units)};
}

// Distance of camera centres (map units) and angle (radians) between two poses.
inline std::pair<double, double> PoseDifference(const Rigid3d& a, const Rigid3d& b) {
  return {(a.TargetOriginInSource() - b.TargetOriginInSource()).norm(),
          RotationAngle(a.rotation * b.rotation.conjugate())};
}

struct PoseSceneOptions {
  int num_points = 500;
  double sigma_px = 0.0;
  double outlier_share = 0.0;  // pixels anywhere in the image
};

struct PoseScene {
  PinholeIntrinsics intrinsics;
  Rigid3d cam_from_world;  // true
  std::vector<PoseObservation> observations;
  std::vector<char> is_outlier;  // true
};

inline Eigen::Vector2d RandomPixel(const PinholeIntrinsics& intrinsics, Random& random) {
  const double x = random.Uniform(0.0, intrinsics.width - 1.0);
  return {x, random.Uniform(0.0, intrinsics.height - 1.0)};
}

// A camera some way from the world's origin that sees points 4 to 60 map units ahead.
inline PoseScene MakePoseScene(const PoseSceneOptions& options, Random& random) {
  PoseScene scene;
  scene.intrinsics = TestIntrinsics();
  scene.cam_from_world = Rigid3d(ExpSo3(RandomVector(random, 1.0)), RandomVector(random, 100.0));
  const Rigid3d world_from_cam = Inverse(scene.cam_from_world);
  for (int i = 0; i < options.num_points; ++i) {
    const Eigen::Vector2d pixel = RandomPixel(scene.intrinsics, random);
    const double depth = 1.0 / random.Uniform(1.0 / 60.0, 1.0 / 4.0);
    PoseObservation observation;
    observation.point_in_world = world_from_cam * (depth * scene.intrinsics.Unproject(pixel));
    observation.pixel = pixel + RandomVector(random, options.sigma_px).head<2>();
    const bool is_outlier = random.Uniform() < options.outlier_share;
    if (is_outlier) observation.pixel = RandomPixel(scene.intrinsics, random);
    scene.is_outlier.push_back(is_outlier);
    scene.observations.push_back(observation);
  }
  return scene;
}

}  // namespace lift_slam
