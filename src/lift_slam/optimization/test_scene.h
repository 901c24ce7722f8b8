#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "lift_slam/optimization/bundle_adjustment.h"
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

struct BundleSceneOptions {
  int num_free_cameras = 6;
  int num_fixed_cameras = 2;
  int num_points = 300;
  int observations_per_point = 5;  // at most; in a row of neighbouring cameras
  double sigma_px = 0.0;
  double outlier_share = 0.0;       // pixels anywhere in the image
  double start_rad = 0.002;         // error of the free cameras' rotations before the adjustment
  double start_map_units = 0.05;    // of their positions
  double start_depth_share = 0.03;  // of the points, relative to their distance
};

struct BundleScene {
  BundleProblem problem;                 // as before the adjustment
  std::vector<Rigid3d> cams_from_world;  // true
  std::vector<Eigen::Vector3d> points;   // true
  std::vector<char> is_outlier;          // true, one an observation
};

// The cameras of a gently curved drive, one a map unit; the first ones are fixed.
inline std::vector<Rigid3d> MakeDrive(int num_cameras) {
  std::vector<Rigid3d> cams_from_world;
  for (int i = 0; i < num_cameras; ++i) {
    const double angle = 0.01 * i;
    const Eigen::Vector3d centre(100.0 * (1.0 - std::cos(angle)), 0.0, 100.0 * std::sin(angle));
    const Eigen::Quaterniond cam_from_world = ExpSo3({0.0, -angle, 0.0});
    cams_from_world.emplace_back(cam_from_world, -(cam_from_world * centre));
  }
  return cams_from_world;
}

inline void AddObservations(const BundleSceneOptions& options, int point, int first_camera,
                            Random& random, BundleScene& scene) {
  const int num_cameras = static_cast<int>(scene.cams_from_world.size());
  const auto& intrinsics = scene.problem.intrinsics;
  int seen = 0;
  for (int c = first_camera; c < num_cameras && seen < options.observations_per_point; ++c) {
    const Eigen::Vector3d x_in_cam = scene.cams_from_world[static_cast<std::size_t>(c)] *
                                     scene.points[static_cast<std::size_t>(point)];
    if (x_in_cam.z() < 1.0) continue;
    BundleObservation observation{c, point, intrinsics.Project(x_in_cam), 1.0};
    observation.pixel += RandomVector(random, options.sigma_px).head<2>();
    const bool is_outlier = random.Uniform() < options.outlier_share;
    if (is_outlier) observation.pixel = RandomPixel(intrinsics, random);
    scene.problem.observations.push_back(observation);
    scene.is_outlier.push_back(is_outlier);
    ++seen;
  }
}

inline BundleScene MakeBundleScene(const BundleSceneOptions& options, Random& random) {
  BundleScene scene;
  scene.problem.intrinsics = TestIntrinsics();
  const int num_cameras = options.num_fixed_cameras + options.num_free_cameras;
  scene.cams_from_world = MakeDrive(num_cameras);
  for (int i = 0; i < options.num_points; ++i) {
    const int first = random.UniformInt(0, num_cameras - 2);
    const Rigid3d& cam_from_world = scene.cams_from_world[static_cast<std::size_t>(first)];
    const double depth = 1.0 / random.Uniform(1.0 / 60.0, 1.0 / 8.0);
    const Eigen::Vector3d x_in_cam =
        depth * scene.problem.intrinsics.Unproject(RandomPixel(scene.problem.intrinsics, random));
    scene.points.push_back(Inverse(cam_from_world) * x_in_cam);
    AddObservations(options, i, first, random, scene);
    const double start = 1.0 + options.start_depth_share * random.Normal();
    scene.problem.points.push_back(Inverse(cam_from_world) * (start * x_in_cam));
  }
  for (int i = 0; i < num_cameras; ++i) {
    const bool is_fixed = i < options.num_fixed_cameras;
    const Rigid3d& cam_from_world = scene.cams_from_world[static_cast<std::size_t>(i)];
    scene.problem.is_camera_fixed.push_back(is_fixed);
    scene.problem.cams_from_world.push_back(
        is_fixed ? cam_from_world
                 : Perturb(cam_from_world, random, options.start_rad, options.start_map_units));
  }
  return scene;
}

}  // namespace lift_slam
