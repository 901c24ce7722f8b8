#include "lift_slam/tracking/tracker.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/geometry/absolute_pose.h"
#include "lift_slam/matching/frame_matcher.h"
#include "lift_slam/matching/observation_alignment.h"
#include "lift_slam/tracking/frame_pose.h"
#include "lift_slam/tracking/local_map.h"

namespace lift_slam {
namespace {

// Below this an image shows nothing that could be tracked.
constexpr int kMinFeatures = 50;
// Where the motion model or, after a recovery, the pose is rough.
constexpr float kWideRadiusFactor = 3.0F;
// Constant velocity is trusted after so many frames in a row that it led to, and when the time from
// frame to frame does not change by more than this share.
constexpr int kMinFramesByMotion = 2;
constexpr double kMaxIntervalChange = 0.25;
// Weight of a frame in the smoothed share of points that are found.
constexpr double kSmoothing = 0.05;

// A motion over `steps` times the time it took.
Rigid3d Over(double steps, const Rigid3d& motion) {
  const Eigen::AngleAxisd turn(motion.rotation);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(steps * turn.angle(), turn.axis())),
          steps * motion.translation};
}

double FoundRatio(const TrackingResult& result) {
  return result.num_visible > 0 ? static_cast<double>(result.num_inliers) / result.num_visible
                                : 0.0;
}

void CountSightings(const std::vector<MapPointId>& visible, const Frame& frame, Map& map) {
  for (const MapPointId id : visible) ++map.point(id).num_visible;
  for (const MapPointId id : frame.map_points) {
    if (MapPoint* point = map.FindPoint(id)) ++point->num_found;
  }
}

}  // namespace

void Tracker::Start(const Map& map, const Frame& last, std::optional<Rigid3d> velocity) {
  last_was_tracked_ = true;
  velocity_ = velocity;
  num_by_motion_ = 0;
  last_ = last;
  KeyFrameMapped(map, map.newest_keyframe());
}

void Tracker::KeyFrameMapped(const Map& map, KeyFrameId keyframe) {
  const KeyFrame& mapped = map.keyframe(keyframe);
  last_.cam_from_world = mapped.cam_from_world;
  last_.map_points = mapped.map_points;
  reference_ = keyframe;
  frames_since_keyframe_ = 0;
}

TrackingResult Tracker::Track(Map& map, Frame& frame) {
  TrackingResult result;
  LocalTrack local;
  prior_.Forget();
  result.thresholds = Thresholds(map);
  ++frames_since_keyframe_;
  if (frame.features->size() < kMinFeatures) {
    result.refusal = FrameRefusal::kTooFewFeatures;
  } else {
    bool found = last_was_tracked_ &&
                 (TrackWithMotionModel(map, frame, result) || TrackReferenceKeyFrame(map, frame));
    if (found) found = TrackLocalMap(map, frame, /*wide=*/false, result, local);
    if (!found && Recover(map, frame)) {
      result.recovered = true;
      found = TrackLocalMap(map, frame, /*wide=*/true, result, local);
    }
    if (!found) {
      result.refusal = result.num_matches < options_.min_inliers ? FrameRefusal::kTooFewTracked
                                                                 : FrameRefusal::kPoseRejected;
    }
  }
  if (result.refusal != FrameRefusal::kNone) return Refuse(result.refusal, frame, result);
  return Conclude(local, frame, result, map);
}

TrackingResult Tracker::Refuse(FrameRefusal refusal, Frame& frame, TrackingResult result) {
  result.refusal = refusal;
  frame.ClearMatches();
  last_was_tracked_ = false;
  velocity_.reset();
  num_by_motion_ = 0;
  adaptive_.looseness = 1.0;
  return result;
}

TrackingResult Tracker::Conclude(const LocalTrack& local, const Frame& frame, TrackingResult result,
                                 Map& map) {
  if (local.reference.valid()) reference_ = local.reference;
  CountSightings(local.visible, frame, map);
  prior_.Learn(frame.cam_from_world);
  adaptive_ = Adapt(adaptive_, matching_, result.num_last_matches, result.num_last_outliers);
  const double ratio = FoundRatio(result);
  usual_found_ratio_ = usual_found_ratio_ > 0.0
                           ? usual_found_ratio_ + kSmoothing * (ratio - usual_found_ratio_)
                           : ratio;
  result.reference = reference_;
  result.needs_keyframe = ShouldBecomeKeyFrame(map, result.num_inliers, reference_,
                                               frames_since_keyframe_, options_.keyframe);
  Remember(frame);
  return result;
}

TrackingResult Tracker::Relocalize(Map& map, Frame& frame, std::span<const KeyFrameId> similar) {
  TrackingResult result;
  ForgetExpected();
  result.thresholds = LoosestThresholds(map);
  result.refusal = FrameRefusal::kPlaceNotRecognized;
  for (const KeyFrameId keyframe : similar) {
    if (map.FindKeyFrame(keyframe) == nullptr) continue;
    if (result.refusal == FrameRefusal::kPlaceNotRecognized) {
      result.refusal = FrameRefusal::kPoseRejected;
    }
    if (!TryKeyFrame(map, keyframe, frame)) continue;
    result.refusal = FrameRefusal::kTooFewTracked;
    LocalTrack local;
    TrackLocalMap(map, frame, /*wide=*/true, result, local);
    if (result.num_inliers < options_.min_relocalised_inliers ||
        FoundRatio(result) < options_.min_relocalised_ratio * usual_found_ratio_) {
      continue;
    }
    result.recovered = true;
    result.refusal = FrameRefusal::kNone;
    return Conclude(local, frame, result, map);
  }
  return Refuse(result.refusal, frame, result);
}

void Tracker::MapCorrected(const Map& map, KeyFrameId keyframe, double scale) {
  KeyFrameMapped(map, keyframe);
  if (velocity_) velocity_->translation *= scale;
  prior_.Rescale(scale);
}

void Tracker::Remember(const Frame& frame) {
  velocity_.reset();
  if (last_was_tracked_) {
    velocity_ = frame.cam_from_world * Inverse(last_.cam_from_world);
    velocity_interval_ns_ = frame.timestamp_ns - last_.timestamp_ns;
  }
  last_ = frame;
  last_was_tracked_ = true;
}

bool Tracker::IsExpectable(const Frame& frame) const {
  return velocity_ && num_by_motion_ >= kMinFramesByMotion && IsAtUsualInterval(frame);
}

bool Tracker::IsAtUsualInterval(const Frame& frame) const {
  const auto interval = static_cast<double>(frame.timestamp_ns - last_.timestamp_ns);
  const auto usual = static_cast<double>(velocity_interval_ns_);
  return std::abs(interval - usual) <= kMaxIntervalChange * usual;
}

Rigid3d Tracker::ExpectedMotion(const Frame& frame) const {
  if (velocity_interval_ns_ <= 0 || IsAtUsualInterval(frame)) return *velocity_;
  return Over(static_cast<double>(frame.timestamp_ns - last_.timestamp_ns) /
                  static_cast<double>(velocity_interval_ns_),
              *velocity_);
}

bool Tracker::TrackWithMotionModel(const Map& map, Frame& frame, TrackingResult& result) {
  frame.cam_from_world =
      velocity_ ? ExpectedMotion(frame) * last_.cam_from_world : last_.cam_from_world;
  if (IsExpectable(frame)) prior_.Expect(last_.cam_from_world, frame.cam_from_world);
  const int enough = std::max(
      options_.min_matches,
      static_cast<int>(options_.min_match_share * static_cast<double>(last_.CountMatches())));
  auto radius = static_cast<float>(options_.search_radius_px);
  int matches = MatchFromLastFrame(map, last_, radius, result.thresholds.high, frame);
  if (matches < enough) {
    frame.ClearMatches();
    radius *= kWideRadiusFactor;
    matches = MatchFromLastFrame(map, last_, radius, result.thresholds.high, frame);
  }
  if (matches < options_.min_matches) result.thresholds = LoosestThresholds(map);
  for (int widening = 0; widening < 2 && matches < options_.min_matches; ++widening) {
    frame.ClearMatches();
    matches = MatchFromLastFrame(map, last_, radius * static_cast<float>(2 << widening),
                                 result.thresholds.high, frame);
  }
  if (matches < options_.min_matches) return false;
  const int inliers =
      OptimizeFramePose(map, options_.pose, frame, prior_.For(matches, frame.features->size()));
  if (inliers < options_.min_inliers_first) return false;
  result.num_last_matches = matches;
  result.num_last_outliers = matches - inliers;
  ++num_by_motion_;
  return true;
}

MatchingThresholds Tracker::LoosestThresholds(const Map& map) const {
  return AdaptiveThresholds{1.0}.In(map.view().thresholds, matching_.thresholds);
}

void Tracker::ForgetExpected() {
  prior_.Forget();
  num_by_motion_ = 0;
}

bool Tracker::TrackReferenceKeyFrame(const Map& map, Frame& frame) {
  ForgetExpected();
  if (map.FindKeyFrame(reference_) == nullptr) return false;
  frame.cam_from_world = last_.cam_from_world;
  return TryKeyFrame(map, reference_, frame);
}

bool Tracker::Recover(const Map& map, Frame& frame) {
  ForgetExpected();
  if (map.num_keyframes() == 0) return false;
  KeyFrameId newest = reference_;
  if (map.FindKeyFrame(newest) == nullptr) newest = map.KeyFrameIds().back();
  if (TryKeyFrame(map, newest, frame)) return true;
  for (const auto& neighbor :
       map.covisibility().Neighbors(newest, 15, options_.recovery_keyframes - 1)) {
    if (TryKeyFrame(map, neighbor.keyframe, frame)) return true;
  }
  return false;
}

bool Tracker::TryKeyFrame(const Map& map, KeyFrameId keyframe, Frame& frame) const {
  frame.ClearMatches();
  const float max_distance = LoosestThresholds(map).low;
  if (MatchFromKeyFrame(map, map.keyframe(keyframe), max_distance, frame) < options_.min_matches) {
    return false;
  }
  const ViewModel& view = map.view();
  std::vector<PointMatch> matches;
  for (int i = 0; i < frame.features->size(); ++i) {
    const MapPoint* point = map.FindPoint(frame.map_points[static_cast<std::size_t>(i)]);
    if (point == nullptr) continue;
    const auto level = static_cast<std::size_t>(frame.features->level(i));
    matches.push_back({point->position, view.pinhole.Unproject(frame.features->pixel(i)).head<2>(),
                       1.0 / std::sqrt(view.inverse_variance[level])});
  }
  const auto pose = EstimateAbsolutePose(matches, 0.5 * (view.pinhole.fx + view.pinhole.fy),
                                         options_.absolute_pose, seed_);
  if (!pose) return false;
  frame.cam_from_world = pose->cam_from_world;
  return OptimizeFramePose(map, options_.pose, frame) >= options_.min_inliers_first;
}

bool Tracker::TrackLocalMap(const Map& map, Frame& frame, bool wide, TrackingResult& result,
                            LocalTrack& local) const {
  const LocalMap around = CollectLocalMap(map, frame, options_.max_local_keyframes);
  if (around.reference.valid()) local.reference = around.reference;
  LocalMatchResult matched = MatchLocalPoints(map, around.points, wide ? kWideRadiusFactor : 1.0F,
                                              result.thresholds.high, frame);
  AlignMatches(map, frame);
  result.num_matches = frame.CountMatches();
  const CenterPrior prior = prior_.For(result.num_matches, frame.features->size());
  result.num_inliers = OptimizeFramePose(map, options_.pose, frame, prior);
  result.num_visible = static_cast<int>(matched.visible.size());
  local.visible = std::move(matched.visible);
  const bool is_expected = prior.inverse_variance > 0.0;
  return result.num_inliers >= (is_expected ? options_.min_inliers_expected : options_.min_inliers);
}

}  // namespace lift_slam
