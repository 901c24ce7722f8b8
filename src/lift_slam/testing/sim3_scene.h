#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

struct Sim3SceneOptions {
  int num_matches = 200;
  double noise_px = 0.5;
  double depth_noise = 0.0;    // relative, of each map point along its ray
  double outlier_ratio = 0.0;  // matches of different places
  double scale = 2.5;          // of cam1_from_cam2
  double offset = 1.0;         // of the cameras, over the usual; 0: both at one place
  std::uint64_t seed = 1;
};

// A match as the solvers of Sim(3) see it: a map point of each camera and where its image shows it.
struct Sim3SceneMatch {
  Eigen::Vector3d point_in_cam1, point_in_cam2;
  Eigen::Vector2d pixel1, pixel2;
  bool is_outlier = false;
};

struct Sim3Scene {
  PinholeIntrinsics pinhole;
  Sim3d cam1_from_cam2;
  std::vector<Sim3SceneMatch> matches;
};

// Two cameras 20 degrees and some map units apart that look at the same points.
inline Sim3Scene MakeSim3Scene(const Sim3SceneOptions& options) {
  Random random(options.seed);
  Sim3Scene scene;
  scene.pinhole = {500.0, 500.0, 319.5, 239.5, 640, 480};
  scene.cam1_from_cam2 = Sim3d(
      options.scale,
      Eigen::Quaterniond(Eigen::AngleAxisd(0.35, Eigen::Vector3d(0.2, 1.0, 0.1).normalized())),
      options.offset * Eigen::Vector3d(-3.0, 0.2, 0.8));
  const Sim3d cam2_from_cam1 = Inverse(scene.cam1_from_cam2);
  const auto noisy_pixel = [&](const Eigen::Vector3d& point) -> Eigen::Vector2d {
    const double x = random.Normal(), y = random.Normal();
    return scene.pinhole.Project(point) + options.noise_px * Eigen::Vector2d(x, y);
  };
  while (static_cast<int>(scene.matches.size()) < options.num_matches) {
    const double x = random.Uniform(0.0, 640.0), y = random.Uniform(0.0, 480.0);
    const Eigen::Vector3d in_cam1 = scene.pinhole.Unproject({x, y}) * random.Uniform(6.0, 25.0);
    const Eigen::Vector3d in_cam2 = cam2_from_cam1 * in_cam1;
    if (!(in_cam2.z() > 0.5)) continue;
    const double depth1 = 1.0 + options.depth_noise * random.Normal();
    const double depth2 = 1.0 + options.depth_noise * random.Normal();
    scene.matches.push_back({depth1 * in_cam1, depth2 * in_cam2, noisy_pixel(in_cam1),
                             noisy_pixel(in_cam2), random.Uniform() < options.outlier_ratio});
  }
  // Outliers get the second half of the match before them.
  for (std::size_t i = scene.matches.size(); i-- > 1;) {
    if (!scene.matches[i].is_outlier) continue;
    scene.matches[i].point_in_cam2 = scene.matches[i - 1].point_in_cam2;
    scene.matches[i].pixel2 = scene.matches[i - 1].pixel2;
  }
  scene.matches[0].is_outlier = false;
  return scene;
}

}  // namespace lift_slam
