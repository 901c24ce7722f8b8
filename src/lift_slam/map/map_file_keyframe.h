#pragma once

#include <memory>

#include "lift_slam/map/frame.h"
#include "lift_slam/map/map_file_records.h"

namespace lift_slam {

void PutPose(const Rigid3d& pose, RecordBytes& record);
Rigid3d TakePose(MapRecordReader& reader);

// A keyframe with its features, without matches and image.
RecordBytes KeyFrameRecordBytes(const KeyFrame& keyframe);
std::unique_ptr<KeyFrame> TakeKeyFrame(MapRecordReader& reader, const ViewModel& view,
                                       const DescriptorKind& features);

}  // namespace lift_slam
