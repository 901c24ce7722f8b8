#include "lift_slam/testing/synthetic_scene.h"

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

bool IsInside(const PinholeIntrinsics& pinhole, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= pinhole.width - 1.0 &&
         pixel.y() <= pinhole.height - 1.0;
}

Eigen::Vector2d RandomPixel(const PinholeIntrinsics& pinhole, Random& random) {
  const double x = random.Uniform(0.0, pinhole.width - 1.0);
  const double y = random.Uniform(0.0, pinhole.height - 1.0);
  return {x, y};
}

Eigen::Vector3d RandomPoint(const PinholeIntrinsics& pinhole, const SyntheticSceneOptions& options,
                            Random& random) {
  const Eigen::Vector3d ray = pinhole.Unproject(RandomPixel(pinhole, random));
  if (options.shape == SyntheticShape::kPlane) {
    const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.2, -1.0).normalized();
    const double distance = 0.5 * (options.min_depth + options.max_depth) * normal.z();
    return ray * (distance / normal.dot(ray));
  }
  return ray * random.Uniform(options.min_depth, options.max_depth);
}

std::vector<SyntheticObservation> Observe(const SyntheticScene& scene,
                                          const Rigid3d& cam_from_world,
                                          const SyntheticSceneOptions& options, Random& random) {
  std::vector<SyntheticObservation> observations;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d in_cam = cam_from_world * scene.points[i];
    if (!(in_cam.z() > 0.05)) continue;
    SyntheticObservation observation;
    observation.point = static_cast<int>(i);
    observation.pixel = scene.pinhole.Project(in_cam);
    observation.pixel.x() += options.noise_px * random.Normal();
    observation.pixel.y() += options.noise_px * random.Normal();
    if (!IsInside(scene.pinhole, observation.pixel)) continue;
    observation.is_outlier = random.Uniform() < options.outlier_ratio;
    if (observation.is_outlier) observation.pixel = RandomPixel(scene.pinhole, random);
    observations.push_back(observation);
  }
  return observations;
}

}  // namespace

PinholeIntrinsics SyntheticPinhole() { return {500.0, 500.0, 319.5, 239.5, 640, 480}; }

SyntheticScene MakeSyntheticScene(const std::vector<Rigid3d>& cams_from_world,
                                  const SyntheticSceneOptions& options) {
  Random random(options.seed);
  SyntheticScene scene;
  scene.pinhole = SyntheticPinhole();
  scene.cams_from_world = cams_from_world;
  for (int i = 0; i < options.num_points; ++i) {
    scene.points.push_back(RandomPoint(scene.pinhole, options, random));
  }
  for (const Rigid3d& cam_from_world : cams_from_world) {
    scene.observations.push_back(Observe(scene, cam_from_world, options, random));
  }
  return scene;
}

std::vector<SyntheticMatch> MatchesBetween(const SyntheticScene& scene, int camera1, int camera2) {
  const auto& in1 = scene.observations.at(static_cast<std::size_t>(camera1));
  const auto& in2 = scene.observations.at(static_cast<std::size_t>(camera2));
  std::vector<SyntheticMatch> matches;
  auto second = in2.begin();
  for (const SyntheticObservation& first : in1) {
    while (second != in2.end() && second->point < first.point) ++second;
    if (second == in2.end()) break;
    if (second->point != first.point) continue;
    matches.push_back(
        {first.point, first.pixel, second->pixel, first.is_outlier || second->is_outlier});
  }
  return matches;
}

}  // namespace lift_slam
