#include "lift_slam/slam/slam_system.h"

#include "lift_slam/slam/run_recorder.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

// A gap is longer than this many intervals of the frames before it: slow input has none.
constexpr std::int64_t kIntervalsOfGap = 5;

}  // namespace

SlamSystem::SlamSystem(const Camera& camera, std::shared_ptr<const ViewModel> view,
                       const SlamOptions& options, std::shared_ptr<const Vocabulary> vocabulary)
    : camera_(camera),
      view_(std::move(view)),
      options_(options),
      maps_(options, std::move(vocabulary), record_) {
  options_.Check();
  BeginInitializing();
}

void SlamSystem::BeginInitializing() {
  state_ = TrackingState::kInitializing;
  initializer_ =
      std::make_unique<MapInitializer>(view_, options_.initializer, options_.local_bundle,
                                       static_cast<std::uint64_t>(options_.seed));
}

void SlamSystem::LoadMaps(MapFile file) {
  maps_.Load(std::move(file.maps));
  if (options_.localization_only) state_ = TrackingState::kLost;
}

const FrameRecord& SlamSystem::Process(const PreparedFrame& prepared) {
  FrameRecord record;
  record.frame_index = prepared.input.frame_index;
  record.timestamp_ns = prepared.input.timestamp_ns;
  record.extract_ms = prepared.extract_ms;
  record.refusal = prepared.input.refusal;
  record.num_impulses = prepared.num_impulses;
  if (record.num_impulses > 0) ++record_.counters["prepare.frames_with_impulse_noise"];
  if (prepared.features) {
    record.num_features = prepared.features->size();
    record_.stage_times_ms["extract"].push_back(prepared.extract_ms);
    if (maps_.active() != nullptr) {
      ProcessTracking(prepared, record);
    } else {
      ProcessWithoutMap(prepared, record);
    }
  }
  frame_interval_ns_ = record_.frames.empty() ? 0 : record.timestamp_ns - last_frame_ns_;
  last_frame_ns_ = record.timestamp_ns;
  record.state = state_;
  ++record_.refusals[static_cast<std::size_t>(record.refusal)];
  record_.frames.push_back(record);
  return record_.frames.back();
}

void SlamSystem::ProcessWithoutMap(const PreparedFrame& prepared, FrameRecord& record) {
  if (!maps_.maps().empty() && Relocalize(prepared, record)) return;
  if (!options_.localization_only) {
    ProcessInitializing(prepared, record);
    return;
  }
  record.refusal = FrameRefusal::kPlaceNotRecognized;
  record.state = state_;
  album_.Offer(prepared, record, {});
}

void SlamSystem::ProcessInitializing(const PreparedFrame& prepared, FrameRecord& record) {
  const Timer timer;
  const Frame frame = prepared.MakeFrame();
  MapInitializer::Result result = initializer_->Process(frame);
  record.refusal = result.refusal;
  record.num_matches = result.num_matches;
  std::vector<int> tracked;
  if (result.initial) {
    maps_.Begin(std::move(*result.initial), prepared.input.image);
    initializer_.reset();
    state_ = TrackingState::kTracking;
    last_tracked_ns_ = record.timestamp_ns;
    const KeyFrame& newest =
        maps_.active()->map().keyframe(maps_.active()->map().newest_keyframe());
    record.world_from_cam = Inverse(newest.cam_from_world);
    record.is_keyframe = true;
    record.map_index = maps_.active_index();
    for (int i = 0; i < newest.features->size(); ++i) {
      if (newest.map_points[static_cast<std::size_t>(i)].valid()) tracked.push_back(i);
    }
    record.num_inliers = static_cast<int>(tracked.size());
    record_.counters["initializer.maps_begun"] += 1;
    record_.counters["initializer.frames_backfilled"] += maps_.active()->num_backfilled();
  }
  record.track_ms = timer.ElapsedMs();
  record_.stage_times_ms["initialize"].push_back(record.track_ms);
  record.state = state_;
  album_.Offer(prepared, record, tracked);
}

void SlamSystem::ProcessTracking(const PreparedFrame& prepared, FrameRecord& record) {
  if (IsAfterGap(record.timestamp_ns)) {
    // The camera may be anywhere; a wrong prediction finds points enough to be believed.
    ++record_.counters["tracking.gaps_in_time"];
    maps_.active()->ForgetMotion();
  }
  const MapSession::Step step = maps_.active()->Process(prepared);
  RecordTracked(step, prepared, record);
  if (record.refusal != FrameRefusal::kNone) HandleLost(prepared, record);
}

bool SlamSystem::IsAfterGap(std::int64_t timestamp_ns) const {
  const std::int64_t gap_ns = timestamp_ns - last_tracked_ns_;
  return state_ == TrackingState::kTracking && frame_interval_ns_ > 0 &&
         gap_ns > kIntervalsOfGap * frame_interval_ns_ &&
         static_cast<double>(gap_ns) * 1e-9 > options_.recovery_time_s;
}

bool SlamSystem::Relocalize(const PreparedFrame& prepared, FrameRecord& record) {
  const auto step = maps_.Relocalize(prepared);
  if (!step) return false;
  state_ = TrackingState::kLost;  // until this frame
  initializer_.reset();
  RecordTracked(*step, prepared, record);
  return true;
}

void SlamSystem::RecordTracked(const MapSession::Step& step, const PreparedFrame& prepared,
                               FrameRecord& record) {
  record.refusal = step.tracking.refusal;
  record.num_matches = step.tracking.num_matches;
  record.num_inliers = step.tracking.num_inliers;
  record.low_threshold = step.tracking.thresholds.low;
  record.high_threshold = step.tracking.thresholds.high;
  record.num_last_matches = step.tracking.num_last_matches;
  record.num_last_outliers = step.tracking.num_last_outliers;
  record.track_ms += step.track_ms;
  record.map_ms += step.map_ms;
  record_.stage_times_ms["track"].push_back(step.track_ms);
  if (record.refusal != FrameRefusal::kNone) return;
  if (step.mapping) CountMapping(*step.mapping);
  if (state_ == TrackingState::kLost) ++record_.relocalisations;
  if (step.tracking.recovered) ++record_.counters["tracking.recovered_by_descriptors"];
  state_ = TrackingState::kTracking;
  last_tracked_ns_ = record.timestamp_ns;
  record.world_from_cam = step.world_from_cam;
  record.is_keyframe = step.mapping.has_value();
  maps_.RecognizePlaces(step);
  record.map_index = maps_.active_index();
  record.state = state_;
  album_.Offer(prepared, record, step.tracked_features);
}

void SlamSystem::HandleLost(const PreparedFrame& prepared, FrameRecord& record) {
  if (state_ == TrackingState::kTracking) ++record_.lost_events;
  state_ = TrackingState::kLost;
  if (Relocalize(prepared, record)) return;
  const bool may_go = maps_.active() == maps_.maps().back().get() && !maps_.active()->is_loaded();
  if (may_go && maps_.active()->map().num_keyframes() < options_.min_keyframes_to_keep) {
    // Lost shortly after start: the map is worth nothing, begin anew with this frame.
    ++record_.counters["tracking.maps_reset"];
    maps_.ThrowAwayActive();
  } else if (static_cast<double>(record.timestamp_ns - last_tracked_ns_) * 1e-9 >
             options_.recovery_time_s) {
    ++record_.counters["tracking.maps_left"];
    maps_.Leave();
  }
  if (maps_.active() == nullptr && !options_.localization_only) {
    BeginInitializing();
    initializer_->Process(prepared.MakeFrame());
  }
  record.state = state_;
  album_.Offer(prepared, record, {});
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
  counters["mapping.points_culled.rarely_found"] += report.points_culled.rarely_found;
  counters["mapping.points_culled.few_observers"] += report.points_culled.few_observers;
  counters["mapping.points_fused"] += report.points_fused;
  counters["mapping.keyframes_culled"] += report.keyframes_culled;
  counters["mapping.observations_rejected"] += report.bundle.outliers;
  if (report.bundle_ms > 0.0 && !report.bundle.solver.usable) {
    ++counters["mapping.local_bundles_failed"];
  }
}

RunRecord SlamSystem::Finish() {
  initializer_.reset();
  if (options_.final_bundle_adjustment) maps_.AdjustAll();
  record_.camera = camera_;
  record_.annotated_frames = album_.Take();
  CompleteRunRecord(maps_.maps(), record_);
  return std::move(record_);
}

}  // namespace lift_slam
