#include "lift_slam/slam/map_session.h"

#include <cmath>

#include "lift_slam/map/keyframe_scales.h"
#include "lift_slam/optimization/map_calibration.h"
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

// Of the sightings of the map's points that were to be expected, those that came true.
double FoundShare(const Map& map) {
  double visible = 0.0, found = 0.0;
  for (const MapPointId id : map.PointIds()) {
    visible += map.point(id).num_visible;
    found += map.point(id).num_found;
  }
  return visible > 0.0 ? found / visible : 0.0;
}

}  // namespace

MapSession::MapSession(InitialMap initial, const GrayImage& image, const SlamOptions& options,
                       std::shared_ptr<const Vocabulary> vocabulary)
    : map_(std::move(initial.map)),
      tracker_(options.tracker, options.matching, static_cast<std::uint64_t>(options.seed)),
      mapper_(options.local_mapper, options.local_bundle),
      correction_options_(options.loop_closing.correction),
      tracker_options_(options.tracker) {
  if (vocabulary) {
    loop_closer_.emplace(options.loop_closing, std::move(vocabulary),
                         static_cast<std::uint64_t>(options.seed));
  }
  const KeyFrameId second = map_->newest_keyframe();
  Frame& current = initial.current;
  Backfill(std::move(initial.waiting), current);
  mapper_.Process(second, map_->view().thresholds.fixed.low, *map_);
  RememberGray(second, image);
  if (loop_closer_) loop_closer_->Update(*map_);
  tracker_.Start(*map_, current, initial_velocity_);
  frames_.push_back({current.frame_index, second, Rigid3d()});
}

MapSession::MapSession(StoredMap stored, const SlamOptions& options,
                       std::shared_ptr<const Vocabulary> vocabulary)
    : map_(std::move(stored.map)),
      tracker_(options.tracker, options.matching, static_cast<std::uint64_t>(options.seed)),
      mapper_(options.local_mapper, options.local_bundle),
      correction_options_(options.loop_closing.correction),
      tracker_options_(options.tracker),
      gray_(std::move(stored.gray_of_point)),
      is_loaded_(true),
      localization_only_(options.localization_only) {
  gray_.resize(map_->num_point_ids(), kUnknownGray);
  tracker_.ExpectFoundRatio(FoundShare(*map_));
  if (!vocabulary) return;
  loop_closer_.emplace(options.loop_closing, std::move(vocabulary),
                       static_cast<std::uint64_t>(options.seed));
  std::vector<LoopEdge> loops;
  for (const auto& [query, candidate] : stored.loops) loops.push_back({query, candidate});
  loop_closer_->Restore(*map_, std::move(loops));
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
  if (step.tracking.refusal == FrameRefusal::kNone) Finish(prepared, frame, step);
  return step;
}

MapSession::Step MapSession::Relocalize(const PreparedFrame& prepared) {
  Step step;
  step.tracking.refusal = FrameRefusal::kTooFewTracked;
  if (!loop_closer_) return step;
  const Timer track_timer;
  Frame frame = prepared.MakeFrame();
  step.tracking =
      tracker_.Relocalize(*map_, frame, loop_closer_->FindSimilar(*frame.features, *map_));
  step.track_ms = track_timer.ElapsedMs();
  if (step.tracking.refusal == FrameRefusal::kNone) Finish(prepared, frame, step);
  return step;
}

void MapSession::Finish(const PreparedFrame& prepared, Frame& frame, Step& step) {
  step.tracked_features = MatchedFeatures(frame);
  FrameReference reference{frame.frame_index, step.tracking.reference, Rigid3d()};
  if (step.tracking.needs_keyframe && !localization_only_) {
    const Timer map_timer;
    InsertKeyFrame(prepared.input.image, frame, step);
    step.map_ms = map_timer.ElapsedMs();
    reference.reference = map_->newest_keyframe();
  } else {
    reference.cam_from_reference =
        frame.cam_from_world * Inverse(map_->keyframe(reference.reference).cam_from_world);
  }
  step.world_from_cam = Inverse(frame.cam_from_world);
  frames_.push_back(reference);
}

void MapSession::InsertKeyFrame(const GrayImage& image, Frame& frame, Step& step) {
  const KeyFrameId keyframe = map_->AddKeyFrame(frame);
  has_new_keyframes_ = true;
  step.mapping = mapper_.Process(keyframe, tracker_.MappingThresholds(*map_).low, *map_);
  RememberGray(keyframe, image);
  tracker_.KeyFrameMapped(*map_, keyframe);
  if (loop_closer_) {
    step.loop = loop_closer_->Process(keyframe, *map_);
    const LoopReport& loop = *step.loop;
    if (loop.bundle) FollowMap(loop.bundle->scale_of_keyframe, keyframe);
    if (loop.closed()) FollowMap(loop.correction->scale_of_keyframe, keyframe);
  }
  frame.cam_from_world = map_->keyframe(keyframe).cam_from_world;
}

void MapSession::FollowMap(const std::vector<double>& scale_of_keyframe, KeyFrameId newest) {
  ScaleFrames(scale_of_keyframe);
  tracker_.MapCorrected(*map_, newest, scale_of_keyframe[newest.index()]);
}

void MapSession::ScaleFrames(const std::vector<double>& scale_of_keyframe) {
  for (FrameReference& frame : frames_) {
    frame.cam_from_reference.translation *= scale_of_keyframe[frame.reference.index()];
  }
}

std::int64_t MapSession::FrameIndexOf(KeyFrameId keyframe) const {
  const auto reference = map_->ResolveReference(keyframe);
  if (!reference) return -1;
  const KeyFrame& standing = map_->keyframe(reference->keyframe);
  return standing.is_loaded ? -1 : standing.frame_index;
}

LoopReport MapSession::FindNewestIn(const MapSession& other) const {
  if (!loop_closer_ || !other.loop_closer_) return {};
  return loop_closer_->FindInOtherMap(map_->newest_keyframe(), *map_, *other.map_,
                                      *other.loop_closer_);
}

FusionCounts MapSession::Absorb(MapSession&& other, const PlaceAttempt& attempt, MergeSide side) {
  const bool query_is_mine = side == MergeSide::kQueryIsMine;
  const Map& query_map = query_is_mine ? *map_ : *other.map_;
  const Rigid3d world_from_query = Inverse(query_map.keyframe(attempt.edge.query).cam_from_world);
  const Sim3d query_world_from_candidate_world =
      Sim3d(1.0, world_from_query.rotation, world_from_query.translation) *
      attempt.match.query_from_candidate_world;
  const Sim3d world_from_other =
      query_is_mine ? query_world_from_candidate_world : Inverse(query_world_from_candidate_world);
  const Map::IdOffset offset = map_->Absorb(std::move(*other.map_), world_from_other);

  PlaceAttempt merged = attempt;
  KeyFrameId& moved = query_is_mine ? merged.edge.candidate : merged.edge.query;
  moved.value += offset.keyframes;
  if (query_is_mine) {
    for (MapPointId& point : merged.match.points) point.value += point.valid() ? offset.points : 0;
  }
  const FusionCounts fused = FusePlaces(merged.match, merged.edge, correction_options_, *map_);
  loop_closer_->Absorb(*other.loop_closer_, offset.keyframes, merged.edge, map_->newest_keyframe());
  mapper_.Absorb(other.mapper_, offset.points);

  for (FrameReference frame : other.frames_) {
    frame.reference.value += offset.keyframes;
    frame.cam_from_reference.translation *= world_from_other.scale;
    frames_.push_back(frame);
  }
  gray_.resize(static_cast<std::size_t>(offset.points), kUnknownGray);
  gray_.insert(gray_.end(), other.gray_.begin(), other.gray_.end());
  num_backfilled_ += other.num_backfilled_;
  has_new_keyframes_ = has_new_keyframes_ || other.is_of_this_run();
  if (!query_is_mine) tracker_ = std::move(other.tracker_);
  tracker_.MapCorrected(*map_, merged.edge.query, query_is_mine ? 1.0 : world_from_other.scale);
  return fused;
}

void MapSession::AdjustFinally(const BundleOptions& bundle,
                               const SelfCalibrationOptions& calibration, StageTimes& times_ms) {
  if (loop_closer_) loop_closer_->GiveUpBundle();
  const KeyFrameScales before(*map_);
  const bool is_short = IsCalibratedAsAWhole(calibration, *map_);
  const auto adjust = [&] {
    const Timer timer;
    const bool usable = AdjustWholeMap(bundle, correction(), *map_).solver.usable;
    times_ms["final_bundle"].push_back(timer.ElapsedMs());
    return usable;
  };
  if (is_short) adjust();
  const Timer timer;
  calibration_ =
      is_short ? SelfCalibrateMap(calibration, *map_) : EstimateCalibration(calibration, *map_);
  times_ms["self_calibration"].push_back(timer.ElapsedMs());
  // The map does not obey a correction that it was not adjusted with.
  if (!is_short && !adjust() && calibration_.usable()) {
    calibration_.refusal = CalibrationRefusal::kNoEstimate;
  }
  const std::vector<double> scales = before.ChangesIn(*map_);
  map_->ScaleReferences(scales);
  ScaleFrames(scales);
}

void MapSession::PrepareToStore(const BundleOptions& bundle) {
  if (correction().IsIdentity()) return;
  AdjustWholeMap(bundle, CalibrationCorrection(), *map_);
  for (const MapPointId id : map_->PointIds()) map_->UpdateViewingRange(id);
  calibration_ = SelfCalibrationReport();
}

MapToStore MapSession::ToStore() const {
  MapToStore stored{*map_, gray_, {}};
  if (!loop_closer_) return stored;
  for (const LoopEdge& loop : loop_closer_->loops()) {
    stored.loops.emplace_back(loop.query, loop.candidate);
  }
  return stored;
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
