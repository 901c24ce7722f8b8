#include "lift_slam/map/map_file_keyframe.h"

namespace lift_slam {
namespace {

constexpr std::size_t kKeypointBytes = 5 * 4;

void PutFeatures(const FrameFeatures& features, RecordBytes& record) {
  record.Put(static_cast<std::uint64_t>(features.size()));
  for (int i = 0; i < features.size(); ++i) {
    const Keypoint& keypoint = features.keypoint(i);
    for (const float value : {keypoint.x, keypoint.y, keypoint.angle_rad, keypoint.response}) {
      record.Put(value);
    }
    record.Put(keypoint.level);
    record.Put(features.undistorted(i).x());
    record.Put(features.undistorted(i).y());
  }
  const Descriptors& descriptors = features.descriptors();
  record.PutArray(
      std::span(descriptors.data(), descriptors.size() * descriptors.kind().BytesPerRow()));
}

std::shared_ptr<const FrameFeatures> TakeFeatures(MapRecordReader& reader, const ViewModel& view,
                                                  const DescriptorKind& kind) {
  const std::size_t count = reader.TakeCount(kKeypointBytes + 8 + kind.BytesPerRow());
  FeatureSet set;
  std::vector<Eigen::Vector2f> undistorted;
  for (std::size_t i = 0; i < count; ++i) {
    Keypoint k;
    for (float* value : {&k.x, &k.y, &k.angle_rad, &k.response}) *value = reader.Take<float>();
    k.level = reader.Take<std::int32_t>();
    if (k.level < 0 || k.level >= view.levels.num_levels) reader.FailDamaged();
    set.keypoints.push_back(k);
    const float x = reader.Take<float>();
    undistorted.emplace_back(x, reader.Take<float>());
  }
  set.descriptors = Descriptors(kind, count);
  reader.TakeArray(std::span(set.descriptors.mutable_data(), count * kind.BytesPerRow()));
  return std::make_shared<FrameFeatures>(std::move(set), std::move(undistorted), view);
}

}  // namespace

void PutPose(const Rigid3d& pose, RecordBytes& record) {
  for (int i = 0; i < 4; ++i) record.Put(pose.rotation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) record.Put(pose.translation[i]);
}

Rigid3d TakePose(MapRecordReader& reader) {
  Rigid3d pose;  // not through its constructor, which normalises and so may change the last bit
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = reader.Take<double>();
  for (int i = 0; i < 3; ++i) pose.translation[i] = reader.Take<double>();
  if (!pose.rotation.coeffs().allFinite() || !pose.translation.allFinite()) reader.FailDamaged();
  return pose;
}

RecordBytes KeyFrameRecordBytes(const KeyFrame& keyframe) {
  RecordBytes record;
  record.Put(keyframe.id.value);
  record.Put(keyframe.frame_index);
  record.Put(keyframe.timestamp_ns);
  PutPose(keyframe.cam_from_world, record);
  PutFeatures(*keyframe.features, record);
  return record;
}

std::unique_ptr<KeyFrame> TakeKeyFrame(MapRecordReader& reader, const ViewModel& view,
                                       const DescriptorKind& features) {
  auto keyframe = std::make_unique<KeyFrame>();
  keyframe->id = KeyFrameId(reader.Take<std::int32_t>());
  if (!keyframe->id.valid()) reader.FailDamaged();
  keyframe->frame_index = reader.Take<std::int64_t>();
  keyframe->timestamp_ns = reader.Take<std::int64_t>();
  keyframe->cam_from_world = TakePose(reader);
  keyframe->features = TakeFeatures(reader, view, features);
  keyframe->is_loaded = true;
  return keyframe;
}

}  // namespace lift_slam
