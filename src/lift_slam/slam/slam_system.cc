#include "lift_slam/slam/slam_system.h"

#include "lift_slam/slam/run_recorder.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {

SlamSystem::SlamSystem(const Camera& camera, std::shared_ptr<const ViewModel> view,
                       const SlamOptions& options)
    : camera_(camera), view_(std::move(view)), options_(options) {
  options_.matching.Check();
  BeginInitializing();
}

void SlamSystem::BeginInitializing() {
  state_ = TrackingState::kInitializing;
  initializer_ =
      std::make_unique<MapInitializer>(view_, options_.initializer, options_.local_bundle,
                                       static_cast<std::uint64_t>(options_.seed));
}

const FrameRecord& SlamSystem::Process(const PreparedFrame& prepared) {
  FrameRecord record;
  record.frame_index = prepared.input.frame_index;
  record.timestamp_ns = prepared.input.timestamp_ns;
  record.extract_ms = prepared.extract_ms;
  record.refusal = prepared.input.refusal;
  if (prepared.features) {
    record.num_features = prepared.features->size();
    record_.stage_times_ms["extract"].push_back(prepared.extract_ms);
    if (session_) {
      ProcessTracking(prepared, record);
    } else {
      ProcessInitializing(prepared, record);
    }
  }
  record.state = state_;
  ++record_.refusals[static_cast<std::size_t>(record.refusal)];
  record_.frames.push_back(record);
  return record_.frames.back();
}

void SlamSystem::ProcessInitializing(const PreparedFrame& prepared, FrameRecord& record) {
  const Timer timer;
  const Frame frame = prepared.MakeFrame();
  MapInitializer::Result result = initializer_->Process(frame);
  record.refusal = result.refusal;
  record.num_matches = result.num_matches;
  std::vector<int> tracked;
  if (result.initial) {
    session_ =
        std::make_unique<MapSession>(std::move(*result.initial), prepared.input.image, options_);
    initializer_.reset();
    state_ = TrackingState::kTracking;
    last_tracked_ns_ = record.timestamp_ns;
    const KeyFrame& newest = session_->map().keyframe(session_->map().newest_keyframe());
    record.world_from_cam = Inverse(newest.cam_from_world);
    record.is_keyframe = true;
    record.map_index = static_cast<int>(finished_.size());
    for (int i = 0; i < newest.features->size(); ++i) {
      if (newest.map_points[static_cast<std::size_t>(i)].valid()) tracked.push_back(i);
    }
    record.num_inliers = static_cast<int>(tracked.size());
    record_.counters["initializer.maps_begun"] += 1;
    record_.counters["initializer.frames_backfilled"] += session_->num_backfilled();
  }
  record.track_ms = timer.ElapsedMs();
  record_.stage_times_ms["initialize"].push_back(record.track_ms);
  record.state = state_;
  album_.Offer(prepared, record, tracked);
}

void SlamSystem::ProcessTracking(const PreparedFrame& prepared, FrameRecord& record) {
  const MapSession::Step step = session_->Process(prepared);
  record.refusal = step.tracking.refusal;
  record.num_matches = step.tracking.num_matches;
  record.num_inliers = step.tracking.num_inliers;
  record.low_threshold = step.tracking.thresholds.low;
  record.high_threshold = step.tracking.thresholds.high;
  record.num_last_matches = step.tracking.num_last_matches;
  record.num_last_outliers = step.tracking.num_last_outliers;
  record.track_ms = step.track_ms;
  record.map_ms = step.map_ms;
  record_.stage_times_ms["track"].push_back(step.track_ms);
  if (step.mapping) CountMapping(*step.mapping);
  if (record.refusal != FrameRefusal::kNone) {
    HandleLost(prepared, record);
  } else {
    if (state_ == TrackingState::kLost) ++record_.relocalisations;
    if (step.tracking.recovered) ++record_.counters["tracking.recovered_by_descriptors"];
    state_ = TrackingState::kTracking;
    last_tracked_ns_ = record.timestamp_ns;
    record.world_from_cam = step.world_from_cam;
    record.is_keyframe = step.mapping.has_value();
    record.map_index = static_cast<int>(finished_.size());
  }
  record.state = state_;
  album_.Offer(prepared, record, step.tracked_features);
}

void SlamSystem::HandleLost(const PreparedFrame& prepared, FrameRecord& record) {
  if (state_ == TrackingState::kTracking) ++record_.lost_events;
  state_ = TrackingState::kLost;
  if (session_->map().num_keyframes() < options_.min_keyframes_to_keep) {
    // Lost shortly after start: the map is worth nothing, begin anew with this frame.
    ++record_.counters["tracking.maps_reset"];
    session_.reset();
    ForgetMapOfFrames(static_cast<int>(finished_.size()));
  } else if (static_cast<double>(record.timestamp_ns - last_tracked_ns_) * 1e-9 >
             options_.recovery_time_s) {
    ++record_.counters["tracking.maps_left"];
    finished_.push_back(std::move(session_));
  }
  if (!session_) {
    BeginInitializing();
    initializer_->Process(prepared.MakeFrame());
  }
}

void SlamSystem::ForgetMapOfFrames(int map_index) {
  for (FrameRecord& frame : record_.frames) {
    if (frame.map_index == map_index) frame.map_index = -1;
  }
}

void SlamSystem::CountMapping(const MappingReport& report) {
  auto& times = record_.stage_times_ms;
  times["map.create_points"].push_back(report.create_ms);
  times["map.fuse_points"].push_back(report.fuse_ms);
  times["map.local_bundle"].push_back(report.bundle_ms);
  times["map.cull_keyframes"].push_back(report.cull_ms);
  auto& counters = record_.counters;
  counters["mapping.keyframes_inserted"] += 1;
  counters["mapping.points_created"] += report.points_created;
  counters["mapping.points_culled"] += report.points_culled;
  counters["mapping.points_fused"] += report.points_fused;
  counters["mapping.keyframes_culled"] += report.keyframes_culled;
  counters["mapping.observations_rejected"] += report.bundle.outliers;
}

void SlamSystem::AdjustFinalMaps() {
  for (const auto& session : finished_) {
    if (session->map().num_keyframes() < 3) continue;
    const Timer timer;
    AdjustWholeMap(options_.final_bundle, session->mutable_map());
    record_.stage_times_ms["final_bundle"].push_back(timer.ElapsedMs());
    const Timer calibration_timer;
    session->SelfCalibrate(options_.self_calibration);
    record_.stage_times_ms["self_calibration"].push_back(calibration_timer.ElapsedMs());
  }
}

RunRecord SlamSystem::Finish() {
  if (session_) finished_.push_back(std::move(session_));
  initializer_.reset();
  if (options_.final_bundle_adjustment) AdjustFinalMaps();
  record_.camera = camera_;
  record_.annotated_frames = album_.Take();
  CompleteRunRecord(finished_, record_);
  return std::move(record_);
}

}  // namespace lift_slam
