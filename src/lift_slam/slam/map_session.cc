#include "lift_slam/slam/map_session.h"

#include <cmath>

#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

constexpr std::uint8_t kUnknownGray = 128;

std::vector<int> MatchedFeatures(const Frame& frame) {
  std::vector<int> features;
  for (std::size_t i = 0; i < frame.map_points.size(); ++i) {
    if (frame.map_points[i].valid()) features.push_back(static_cast<int>(i));
  }
  return features;
}

}  // namespace

MapSession::MapSession(InitialMap initial, const GrayImage& image, const SlamOptions& options)
    : map_(std::move(initial.map)),
      tracker_(options.tracker, options.matching, static_cast<std::uint64_t>(options.seed)),
      mapper_(options.local_mapper, options.local_bundle),
      tracker_options_(options.tracker) {
  const KeyFrameId second = map_->newest_keyframe();
  Frame& current = initial.current;
  Backfill(std::move(initial.waiting), current);
  mapper_.Process(second, map_->view().thresholds.fixed.low, *map_);
  RememberGray(second, image);
  tracker_.Start(*map_, current, initial_velocity_);
  frames_.push_back({current.frame_index, second, Rigid3d()});
}

void MapSession::Backfill(std::vector<Frame> waiting, const Frame& current) {
  const KeyFrame& first = map_->keyframe(KeyFrameId(0));
  frames_.push_back({first.frame_index, first.id, Rigid3d()});
  const std::int64_t newest_waiting = waiting.back().frame_index;
  std::int64_t nearest = first.frame_index;
  Rigid3d nearest_pose = first.cam_from_world;
  for (const BackfilledFrame& frame :
       TrackBackwards(*map_, current, std::move(waiting), tracker_options_)) {
    frames_.push_back({frame.frame_index, frame.reference, frame.cam_from_reference});
    ++num_backfilled_;
    if (frame.frame_index > nearest) {
      nearest = frame.frame_index;
      nearest_pose = frame.cam_from_reference * map_->keyframe(frame.reference).cam_from_world;
    }
  }
  if (nearest == newest_waiting) {
    initial_velocity_ = current.cam_from_world * Inverse(nearest_pose);
  }
}

MapSession::Step MapSession::Process(const PreparedFrame& prepared) {
  Step step;
  const Timer track_timer;
  Frame frame = prepared.MakeFrame();
  step.tracking = tracker_.Track(*map_, frame);
  step.track_ms = track_timer.ElapsedMs();
  if (step.tracking.refusal != FrameRefusal::kNone) return step;

  step.tracked_features = MatchedFeatures(frame);
  FrameReference reference{frame.frame_index, step.tracking.reference, Rigid3d()};
  if (step.tracking.needs_keyframe) {
    const Timer map_timer;
    step.mapping = InsertKeyFrame(frame, prepared.input.image);
    step.map_ms = map_timer.ElapsedMs();
    reference.reference = map_->newest_keyframe();
  } else {
    reference.cam_from_reference =
        frame.cam_from_world * Inverse(map_->keyframe(reference.reference).cam_from_world);
  }
  step.world_from_cam = Inverse(frame.cam_from_world);
  frames_.push_back(reference);
  return step;
}

MappingReport MapSession::InsertKeyFrame(Frame& frame, const GrayImage& image) {
  const KeyFrameId keyframe = map_->AddKeyFrame(frame);
  MappingReport report = mapper_.Process(keyframe, tracker_.Thresholds(*map_).low, *map_);
  RememberGray(keyframe, image);
  tracker_.KeyFrameMapped(*map_, keyframe);
  frame.cam_from_world = map_->keyframe(keyframe).cam_from_world;
  return report;
}

void MapSession::SelfCalibrate(const SelfCalibrationOptions& options) {
  const SelfCalibrationReport report = SelfCalibrateMap(options, *map_);
  if (report.usable) correction_ = report.correction;
}

void MapSession::RememberGray(KeyFrameId keyframe_id, const GrayImage& image) {
  const KeyFrame& keyframe = map_->keyframe(keyframe_id);
  for (int i = 0; i < keyframe.features->size(); ++i) {
    const MapPointId id = keyframe.map_points[static_cast<std::size_t>(i)];
    if (!id.valid()) continue;
    if (id.index() >= gray_.size()) gray_.resize(id.index() + 1, kUnknownGray);
    const Keypoint& keypoint = keyframe.features->keypoint(i);
    const int x = std::clamp(static_cast<int>(std::lround(keypoint.x)), 0, image.width() - 1);
    const int y = std::clamp(static_cast<int>(std::lround(keypoint.y)), 0, image.height() - 1);
    gray_[id.index()] = image.row(y)[x];
  }
}

}  // namespace lift_slam
