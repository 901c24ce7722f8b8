#include "lift_slam/matching/observation_alignment.h"

#include <Eigen/LU>

#include "lift_slam/image/patch_alignment.h"

namespace lift_slam {
namespace {

// An image to align in, and the camera's pose (at least nearly).
struct Target {
  const ViewModel& view;
  const ImagePyramid& image;
  const FrameFeatures& features;
  Rigid3d cam_from_world;
};

Eigen::Vector2d RawPixel(const FrameFeatures& features, int feature) {
  const Keypoint& keypoint = features.keypoint(feature);
  return Eigen::Vector2f(keypoint.x, keypoint.y).cast<double>();
}

std::optional<Eigen::Vector2d> Undistort(const ViewModel& view, const Eigen::Vector2d& raw) {
  return view.undistortion ? view.undistortion->Undistort(raw) : raw;
}

// Derivative of the undistorted pixel by the raw one, over a distance of `step_px`.
std::optional<Eigen::Matrix2d> UndistortionJacobian(const ViewModel& view,
                                                    const Eigen::Vector2d& raw, double step_px) {
  if (!view.undistortion || view.undistortion->IsIdentity()) return Eigen::Matrix2d::Identity();
  Eigen::Matrix2d jacobian;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = step_px * Eigen::Vector2d::Unit(i);
    const auto before = Undistort(view, raw - step), after = Undistort(view, raw + step);
    if (!before || !after) return std::nullopt;
    jacobian.col(i) = (*after - *before) / (2.0 * step_px);
  }
  return jacobian;
}

// Where the point's anchor stands; nothing when its keyframe and all that stood for it are gone.
std::optional<Rigid3d> AnchorPose(const Map& map, const MapPoint::Anchor& anchor) {
  const auto reference = map.ResolveReference(anchor.keyframe);
  if (!reference) return std::nullopt;
  return reference->cam_from_keyframe * map.keyframe(reference->keyframe).cam_from_world;
}

// How the anchor's patch looks to the target's camera if its surface faces the anchor's camera.
// Undistorted pixels; the centre is left to the caller.
std::optional<PatchView> PredictView(const Target& target, const MapPoint& point,
                                     const Rigid3d& anchor_from_world) {
  const PinholeIntrinsics& pinhole = target.view.pinhole;
  const MapPoint::Anchor& anchor = *point.anchor;
  const double depth = (anchor_from_world * point.position).z();
  if (!(depth > 0.0)) return std::nullopt;
  const Rigid3d cam_from_anchor = target.cam_from_world * Inverse(anchor_from_world);
  const Eigen::Vector2d pixel = anchor.pixel.cast<double>();
  const Eigen::Vector3d in_cam = cam_from_anchor * (pinhole.Unproject(pixel) * depth);
  if (!(in_cam.z() > 1e-3 * depth)) return std::nullopt;
  PatchView predicted;
  const Eigen::Vector2d center = pinhole.Project(in_cam);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d beside = pixel + anchor.undistorted_from_patch.col(i).cast<double>();
    const Eigen::Vector3d beside_in_cam = cam_from_anchor * (pinhole.Unproject(beside) * depth);
    if (!(beside_in_cam.z() > 1e-3 * depth)) return std::nullopt;
    predicted.image_from_patch.col(i) = pinhole.Project(beside_in_cam) - center;
  }
  const Eigen::Vector3d& t = cam_from_anchor.translation;
  predicted.parallax = {pinhole.fx * (t.x() - in_cam.x() / in_cam.z() * t.z()) / in_cam.z(),
                        pinhole.fy * (t.y() - in_cam.y() / in_cam.z() * t.z()) / in_cam.z()};
  return predicted;
}

// The undistorted pixel at which the point's patch is found near the feature.
std::optional<Eigen::Vector2f> Align(const Map& map, const Target& target, const MapPoint& point,
                                     int feature) {
  if (!point.anchor) return std::nullopt;
  const auto anchor_pose = AnchorPose(map, *point.anchor);
  if (!anchor_pose) return std::nullopt;
  auto expected = PredictView(target, point, *anchor_pose);
  if (!expected) return std::nullopt;
  expected->center = RawPixel(target.features, feature);
  const auto jacobian = UndistortionJacobian(target.view, expected->center, 1.0);
  if (!jacobian) return std::nullopt;
  const Eigen::Matrix2d raw_from_undistorted = jacobian->inverse();
  expected->image_from_patch = raw_from_undistorted * expected->image_from_patch;
  expected->parallax = raw_from_undistorted * expected->parallax;
  const auto aligned =
      AlignPatch(point.anchor->patch, target.image, *expected, target.view.alignment);
  if (!aligned) return std::nullopt;
  const auto pixel = Undistort(target.view, aligned->center);
  if (!pixel) return std::nullopt;
  return pixel->cast<float>();
}

}  // namespace

void AnchorPoint(MapPointId point_id, KeyFrameId keyframe_id, Map& map) {
  const KeyFrame& keyframe = map.keyframe(keyframe_id);
  MapPoint& point = map.point(point_id);
  const int feature = point.FeatureIn(keyframe_id);
  if (!keyframe.pyramid || feature < 0) return;
  const double scale =
      map.view().scale[static_cast<std::size_t>(keyframe.features->level(feature))];
  const Eigen::Vector2d raw = RawPixel(*keyframe.features, feature);
  const auto jacobian = UndistortionJacobian(map.view(), raw, scale);
  const auto patch = CutReferencePatch(*keyframe.pyramid, raw, scale);
  if (!patch || !jacobian) return;
  point.anchor = MapPoint::Anchor{keyframe_id, keyframe.features->undistorted(feature),
                                  (*jacobian * scale).cast<float>(), *patch};
  map.SetAlignedPixel(point_id, keyframe_id, keyframe.features->undistorted(feature));
}

bool AlignObservation(MapPointId point_id, KeyFrameId keyframe_id, Map& map) {
  const KeyFrame& keyframe = map.keyframe(keyframe_id);
  const MapPoint& point = map.point(point_id);
  const int feature = point.FeatureIn(keyframe_id);
  if (!keyframe.pyramid || feature < 0) return false;
  const Target target{map.view(), *keyframe.pyramid, *keyframe.features, keyframe.cam_from_world};
  const auto aligned = Align(map, target, point, feature);
  map.SetAlignedPixel(point_id, keyframe_id, aligned);
  return aligned.has_value();
}

int AlignMatches(const Map& map, Frame& frame) {
  frame.aligned_pixels.clear();
  if (!frame.pyramid) return 0;
  frame.aligned_pixels.resize(frame.map_points.size());
  const Target target{map.view(), *frame.pyramid, *frame.features, frame.cam_from_world};
  int num_aligned = 0;
  for (std::size_t i = 0; i < frame.map_points.size(); ++i) {
    const MapPoint* point = map.FindPoint(frame.map_points[i]);
    if (point == nullptr) continue;
    frame.aligned_pixels[i] = Align(map, target, *point, static_cast<int>(i));
    num_aligned += frame.aligned_pixels[i] ? 1 : 0;
  }
  return num_aligned;
}

}  // namespace lift_slam
