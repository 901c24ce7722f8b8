#include "lift_slam/tracking/frame_pose.h"

namespace lift_slam {

int OptimizeFramePose(const Map& map, const PoseOptimizationOptions& options, Frame& frame,
                      const CenterPrior& prior) {
  std::vector<PoseObservation> observations;
  std::vector<std::size_t> features;
  for (std::size_t i = 0; i < frame.map_points.size(); ++i) {
    const MapPoint* point = map.FindPoint(frame.map_points[i]);
    if (point == nullptr) continue;
    const int feature = static_cast<int>(i);
    const auto aligned = frame.AlignedPixel(feature);
    const Eigen::Vector2d pixel =
        aligned ? aligned->cast<double>() : frame.features->pixel(feature);
    observations.push_back(
        {pixel, point->position,
         map.view().InverseVariance(frame.features->level(feature), aligned.has_value())});
    features.push_back(i);
  }
  const PoseOptimizationResult result =
      OptimizePose(map.view().pinhole, frame.cam_from_world, observations, options, prior);
  frame.cam_from_world = result.cam_from_world;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (!result.is_inlier[k]) frame.map_points[features[k]] = MapPointId();
  }
  return result.num_inliers;
}

}  // namespace lift_slam
