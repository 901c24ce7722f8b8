#include "lift_slam/tracking/map_initializer.h"

#include <cmath>

#include "lift_slam/matching/observation_alignment.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// Newest waiting frames whose images are kept: 1 to 6 MB each.
constexpr std::size_t kImagesKept = 20;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

FrameRefusal RefusalOf(TwoViewStatus status) {
  switch (status) {
    case TwoViewStatus::kSuccess:
      return FrameRefusal::kNone;
    case TwoViewStatus::kTooFewMatches:
      return FrameRefusal::kTooFewMatches;
    case TwoViewStatus::kLowParallax:
      return FrameRefusal::kLowParallax;
    case TwoViewStatus::kPureRotation:
      return FrameRefusal::kPureRotation;
    case TwoViewStatus::kAmbiguousPlanar:
      return FrameRefusal::kAmbiguousPlanar;
    case TwoViewStatus::kTooFewPoints:
      return FrameRefusal::kTooFewPoints;
  }
  return FrameRefusal::kTooFewPoints;
}

// Moves and scales the map so that the median depth of the first keyframe is 1.
void NormalizeScale(Map& map) {
  const std::vector<double> depths = map.SceneDepths(KeyFrameId(0));
  LIFT_SLAM_CHECK(!depths.empty(), "the first keyframe sees nothing");
  const double scale = 1.0 / depths[depths.size() / 2];
  for (const KeyFrameId id : map.KeyFrameIds()) {
    Rigid3d pose = map.keyframe(id).cam_from_world;
    pose.translation *= scale;
    map.SetPose(id, pose);
  }
  for (const MapPointId id : map.PointIds()) {
    map.point(id).position *= scale;
    map.UpdateAppearance(id);
  }
}

}  // namespace

MapInitializer::Result MapInitializer::Process(const Frame& frame) {
  Result result;
  if (frame.features->size() < options_.min_features) {
    result.refusal = FrameRefusal::kTooFewFeatures;
    return result;
  }
  if (waiting_.empty()) {
    waiting_.push_back(frame);
    SetReference(0);
    result.refusal = FrameRefusal::kFirstFrame;
    return result;
  }
  const auto radius = static_cast<float>(options_.search_window_ratio * view_->pinhole.width);
  const std::vector<FeatureMatch> matches =
      MatchWithinWindow(*reference().features, *frame.features, expected_, radius, *view_);
  result.num_matches = static_cast<int>(matches.size());
  TwoViewReconstruction two_view = Reconstruct(frame, matches);
  result.refusal = RefusalOf(two_view.status);
  if (result.refusal == FrameRefusal::kNone) {
    result.initial = BuildMap(frame, matches, std::move(two_view));
    if (result.initial) return result;
    result.refusal = FrameRefusal::kPoorReconstruction;
  }
  for (const FeatureMatch& match : matches) {
    expected_[Index(match.a)] = frame.features->undistorted(match.b);
  }
  waiting_.push_back(frame);
  LetGoOfOldImage();
  poor_frames_ = result.refusal == FrameRefusal::kTooFewMatches ? poor_frames_ + 1 : 0;
  if (poor_frames_ >= options_.max_poor_frames) MoveReference();
  if (waiting_.size() > Index(options_.max_waiting_frames) && reference_ > 0) {
    waiting_.erase(waiting_.begin());
    --reference_;
  } else if (waiting_.size() > Index(options_.max_waiting_frames)) {
    waiting_.erase(waiting_.begin() + 1);
  }
  return result;
}

void MapInitializer::SetReference(std::size_t waiting_index) {
  reference_ = waiting_index;
  poor_frames_ = 0;
  expected_.clear();
  for (int i = 0; i < reference().features->size(); ++i) {
    expected_.push_back(reference().features->undistorted(i));
  }
}

// The reference's image is needed, and those it may move to.
void MapInitializer::LetGoOfOldImage() {
  if (waiting_.size() <= kImagesKept) return;
  const std::size_t old = waiting_.size() - 1 - kImagesKept;
  if (old != reference_) waiting_[old].pyramid.reset();
}

void MapInitializer::MoveReference() { SetReference((reference_ + waiting_.size()) / 2); }

TwoViewReconstruction MapInitializer::Reconstruct(const Frame& frame,
                                                  const std::vector<FeatureMatch>& matches) const {
  std::vector<TwoViewMatch> rays;
  for (const FeatureMatch& match : matches) {
    TwoViewMatch ray;
    ray.normalized1 = view_->pinhole.Unproject(reference().features->pixel(match.a)).head<2>();
    ray.normalized2 = view_->pinhole.Unproject(frame.features->pixel(match.b)).head<2>();
    const int level =
        std::max(reference().features->level(match.a), frame.features->level(match.b));
    ray.sigma_px = 1.0 / std::sqrt(view_->inverse_variance[Index(level)]);
    rays.push_back(ray);
  }
  const double focal_length_px = 0.5 * (view_->pinhole.fx + view_->pinhole.fy);
  return ReconstructTwoViews(rays, focal_length_px, options_.two_view, seed_);
}

std::optional<InitialMap> MapInitializer::BuildMap(const Frame& frame,
                                                   const std::vector<FeatureMatch>& matches,
                                                   TwoViewReconstruction two_view) const {
  InitialMap initial;
  initial.map = std::make_unique<Map>(view_);
  Map& map = *initial.map;
  Frame first = reference();
  first.cam_from_world = Rigid3d();
  initial.current = frame;
  initial.current.cam_from_world = two_view.cam2_from_cam1;
  const KeyFrameId first_id = map.AddKeyFrame(first);
  const KeyFrameId second_id = map.AddKeyFrame(initial.current);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (!two_view.points[k]) continue;
    const MapPointId point = map.AddPoint(*two_view.points[k], second_id);
    map.AddObservation(point, first_id, matches[k].a);
    map.AddObservation(point, second_id, matches[k].b);
    map.UpdateAppearance(point);
    AnchorPoint(point, second_id, map);
    AlignObservation(point, first_id, map);
  }
  if (map.num_points() < options_.min_points) return std::nullopt;
  const MapBundleReport report = AdjustWholeMap(bundle_options_, CalibrationCorrection(), map);
  if (!report.solver.usable || map.num_points() < options_.min_points) return std::nullopt;
  NormalizeScale(map);
  initial.current.cam_from_world = map.keyframe(second_id).cam_from_world;
  initial.current.map_points = map.keyframe(second_id).map_points;
  initial.waiting = waiting_;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    if (i != reference_) initial.waiting[i].pyramid.reset();
  }
  initial.two_view = std::move(two_view);
  return initial;
}

}  // namespace lift_slam
