#include "lift_slam/loop_closing/place_verifier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "lift_slam/geometry/absolute_pose.h"
#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/loop_closing/place_sighting.h"
#include "lift_slam/loop_closing/word_matching.h"
#include "lift_slam/optimization/pose_graph.h"
#include "lift_slam/optimization/sim3_optimization.h"
#include "lift_slam/util/median.h"

namespace lift_slam {
namespace {

constexpr int kWindowMinShared = 15;
// Ratios of depths within this factor of their median agree.
constexpr double kScaleTolerance = 1.3;

Sim3d AsSimilarity(const Rigid3d& pose) { return {1.0, pose.rotation, pose.translation}; }

// Relative error of a depth on which two maps agree at best, however wide the views are apart.
constexpr double kMinLogDepthSigma = 0.02;

double FocalLength(const Map& map) { return 0.5 * (map.view().pinhole.fx + map.view().pinhole.fy); }

// Of the logarithm of a point's depth: the noise of a pixel over the widest angle between the ray
// from a keyframe that sees the point, or would, and those of its observers.
double LogDepthSigma(const Map& map, const MapPoint& point, const Eigen::Vector3d& center) {
  double widest = 0.0;
  for (const MapPoint::Observation& seen : point.observations) {
    const Rigid3d& observer = map.keyframe(seen.keyframe).cam_from_world;
    widest =
        std::max(widest, ParallaxAngle(center, observer.TargetOriginInSource(), point.position));
  }
  return widest > 0.0 ? 1.0 / (FocalLength(map) * widest) : std::numeric_limits<double>::infinity();
}

// Works with one query and one candidate; "place" is the candidate's window.
class Verifier {
 public:
  Verifier(const PlaceView& query, const PlaceView& candidate,
           const PlaceVerificationOptions& options)
      : query_(query),
        candidate_(candidate),
        options_(options),
        sighting_options_{options.search_radius_factor, options.max_squared_error},
        keyframe_(query.map.keyframe(query.keyframe)),
        candidate_from_world_(candidate.map.keyframe(candidate.keyframe).cam_from_world),
        window_(WithNeighbors(candidate.map, candidate.keyframe, kWindowMinShared,
                              options.window_keyframes)),
        place_points_(candidate.map.PointsSeenBy(window_)) {}

  PlaceMatch Run(std::uint64_t seed) {
    PlaceMatch match;
    match.points.resize(keyframe_.map_points.size());
    match.rejection = FindSimilarity(seed, match);
    if (match.rejection == PlaceRejection::kAccepted) match.rejection = Confirm(match);
    return match;
  }

 private:
  // A match of a feature of the query with both map points, ready for the solvers.
  struct Correspondence {
    std::size_t feature = 0;
    Sim3Observation observation;
  };

  PlaceRejection FindSimilarity(std::uint64_t seed, PlaceMatch& match) {
    match.num_word_matches = MatchByWords(match.points);
    if (match.num_word_matches < options_.min_word_matches) return PlaceRejection::kFewWordMatches;
    const auto query_from_candidate = EstimateByRansac(seed, match);
    if (!query_from_candidate) return PlaceRejection::kNoSimilarity;
    SetSimilarity(*query_from_candidate, match);
    FindGuided(match);
    match.num_inliers = Optimize(match);
    if (match.num_inliers < options_.min_inliers) return PlaceRejection::kFewInliers;
    FindGuided(match);
    match.num_inliers = Optimize(match);
    if (match.num_inliers < options_.min_inliers) return PlaceRejection::kFewInliers;
    return PlaceRejection::kAccepted;
  }

  // Matches the query with each keyframe of the window; the first that matches a feature has it.
  int MatchByWords(std::vector<MapPointId>& points) const {
    const float max_distance = query_.map.view().thresholds.loose.low;
    std::set<MapPointId> used;
    for (const KeyFrameId id : window_) {
      if (!candidate_.places.Has(id)) continue;
      const KeyFrame& other = candidate_.map.keyframe(id);
      for (const FeatureMatch& found :
           MatchPointsByWords(keyframe_, query_.places.Direct(query_.keyframe), other,
                              candidate_.places.Direct(id), max_distance)) {
        MapPointId& slot = points[static_cast<std::size_t>(found.a)];
        const MapPointId point = other.map_points[static_cast<std::size_t>(found.b)];
        if (!slot.valid() && used.insert(point).second) slot = point;
      }
    }
    return static_cast<int>(used.size());
  }

  std::vector<Correspondence> Correspondences(const std::vector<MapPointId>& points) const {
    std::vector<Correspondence> correspondences;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MapPoint* own = query_.map.FindPoint(keyframe_.map_points[i]);
      const MapPoint* other = candidate_.map.FindPoint(points[i]);
      if (own == nullptr || other == nullptr) continue;
      Sim3Observation o;
      o.point_in_cam1 = keyframe_.cam_from_world * own->position;
      o.point_in_cam2 = candidate_from_world_ * other->position;
      if (!(o.point_in_cam1.z() > 0.0) || !(o.point_in_cam2.z() > 0.0)) continue;
      const int feature = static_cast<int>(i);
      o.pixel1 = keyframe_.features->pixel(feature);
      o.inverse_variance1 =
          query_.map.view().InverseVariance(keyframe_.features->level(feature), false);
      SetPixelOfCandidate(*other, o);
      o.log_depth_sigma = std::hypot(
          kMinLogDepthSigma,
          LogDepthSigma(query_.map, *own, keyframe_.cam_from_world.TargetOriginInSource()),
          LogDepthSigma(candidate_.map, *other, candidate_from_world_.TargetOriginInSource()));
      correspondences.push_back({i, o});
    }
    return correspondences;
  }

  // Where the candidate itself sees the point; else where it would, as other keyframes say.
  void SetPixelOfCandidate(const MapPoint& point, Sim3Observation& o) const {
    const ViewModel& view = candidate_.map.view();
    const KeyFrame& keyframe = candidate_.map.keyframe(candidate_.keyframe);
    int feature = point.FeatureIn(candidate_.keyframe);
    int level = 0;
    if (feature >= 0) {
      o.pixel2 = keyframe.features->pixel(feature);
      level = keyframe.features->level(feature);
    } else {
      o.pixel2 = view.pinhole.Project(o.point_in_cam2);
      const auto& first = point.observations.front();
      level = candidate_.map.keyframe(first.keyframe).features->level(first.feature);
    }
    o.inverse_variance2 = view.InverseVariance(level, false);
  }

  // The query's camera by the candidate's points alone, as its own may still be rough; then the
  // scale by the depths of both.
  std::optional<Sim3d> EstimateByRansac(std::uint64_t seed, PlaceMatch& match) const {
    const std::vector<MapPointId> points =
        std::exchange(match.points, std::vector<MapPointId>(match.points.size()));
    std::vector<PointMatch> matches;
    std::vector<std::size_t> features;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MapPoint* point = candidate_.map.FindPoint(points[i]);
      if (point == nullptr) continue;
      const ViewModel& view = query_.map.view();
      const int feature = static_cast<int>(i);
      const double inverse_variance =
          view.InverseVariance(keyframe_.features->level(feature), false);
      matches.push_back({point->position,
                         view.pinhole.Unproject(keyframe_.features->pixel(feature)).head<2>(),
                         1.0 / std::sqrt(inverse_variance)});
      features.push_back(i);
    }
    const auto pose = EstimateAbsolutePose(matches, FocalLength(query_.map), options_.ransac, seed);
    if (!pose) return std::nullopt;
    match.num_ransac_inliers = pose->num_inliers;
    std::vector<double> scales;  // of the query's map over the candidate's
    for (std::size_t k = 0; k < matches.size(); ++k) {
      const MapPoint* own = query_.map.FindPoint(keyframe_.map_points[features[k]]);
      if (own == nullptr || !pose->is_inlier[k]) continue;
      const double depth = (keyframe_.cam_from_world * own->position).z();
      const double other = (pose->cam_from_world * matches[k].point_in_world).z();
      if (depth > 0.0 && other > 0.0) scales.push_back(depth / other);
    }
    const auto scale = CommonScale(std::move(scales));
    if (!scale) return std::nullopt;
    const Sim3d query_from_candidate_world =
        Sim3d(*scale, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()) *
        AsSimilarity(pose->cam_from_world);
    return query_from_candidate_world * AsSimilarity(Inverse(candidate_from_world_));
  }

  // The median, when enough of the ratios are near it: two cameras at one place see the same of two
  // maps whatever their shapes and scales, so reprojection alone does not tell.
  std::optional<double> CommonScale(const std::vector<double>& scales) const {
    if (static_cast<int>(scales.size()) < options_.min_scale_matches) return std::nullopt;
    const double median = Median(scales);
    const auto agreeing = std::ranges::count_if(scales, [&](double scale) {
      return scale < kScaleTolerance * median && scale > median / kScaleTolerance;
    });
    const auto share = static_cast<double>(agreeing) / static_cast<double>(scales.size());
    return share < options_.min_scale_share ? std::nullopt : std::optional(median);
  }

  void SetSimilarity(const Sim3d& query_from_candidate, PlaceMatch& match) const {
    match.query_from_candidate_world = query_from_candidate * AsSimilarity(candidate_from_world_);
  }

  // Looks for the place's points in a keyframe of the query's map that a similarity puts there.
  Sighting FindPlacePoints(const KeyFrame& keyframe, const Sim3d& cam_from_candidate_world) const {
    return FindPoints(candidate_.map, place_points_, keyframe,
                      CorrectedPose(cam_from_candidate_world), sighting_options_);
  }

  void FindGuided(PlaceMatch& match) const {
    Sighting sighting = FindPlacePoints(keyframe_, match.query_from_candidate_world);
    match.points = std::move(sighting.points);
    match.num_projected = sighting.num_found;
    match.found_ratio = sighting.FoundRatio();
  }

  // How well a keyframe sees the points around itself.
  double OwnFoundRatio(const Map& map, KeyFrameId id) const {
    std::vector<KeyFrameId> around =
        WithNeighbors(map, id, kWindowMinShared, options_.window_keyframes);
    around.erase(around.begin());  // itself
    if (around.empty()) return 1.0;
    const KeyFrame& keyframe = map.keyframe(id);
    return FindPoints(map, map.PointsSeenBy(around), keyframe, keyframe.cam_from_world,
                      sighting_options_)
        .FoundRatio();
  }

  // How well the candidate sees the points around the query.
  double ReverseFoundRatio(const PlaceMatch& match) const {
    const Sim3d candidate_from_query_world = AsSimilarity(candidate_from_world_) *
                                             Inverse(match.query_from_candidate_world) *
                                             AsSimilarity(keyframe_.cam_from_world);
    const std::vector<KeyFrameId> around =
        WithNeighbors(query_.map, query_.keyframe, kWindowMinShared, options_.window_keyframes);
    return FindPoints(query_.map, query_.map.PointsSeenBy(around),
                      candidate_.map.keyframe(candidate_.keyframe),
                      CorrectedPose(candidate_from_query_world), sighting_options_)
        .FoundRatio();
  }

  void CompareShares(PlaceMatch& match) const {
    match.own_found_ratio = OwnFoundRatio(query_.map, query_.keyframe);
    match.reverse_own_found_ratio = OwnFoundRatio(candidate_.map, candidate_.keyframe);
    match.reverse_found_ratio = ReverseFoundRatio(match);
    const double own = match.own_found_ratio * match.reverse_own_found_ratio;
    match.mutual_ratio =
        own > 0.0 ? std::sqrt(match.found_ratio * match.reverse_found_ratio / own) : 0.0;
  }

  int Optimize(PlaceMatch& match) const {
    const std::vector<Correspondence> correspondences = Correspondences(match.points);
    std::vector<Sim3Observation> observations;
    for (const Correspondence& c : correspondences) observations.push_back(c.observation);
    const Sim3d initial =
        match.query_from_candidate_world * AsSimilarity(Inverse(candidate_from_world_));
    const Sim3OptimizationResult result =
        OptimizeSim3(query_.map.view().pinhole, candidate_.map.view().pinhole, initial,
                     observations, ScaleFit::kFree, options_.sim3);
    SetSimilarity(result.cam1_from_cam2, match);
    return result.num_inliers;
  }

  double OffsetRatio(const PlaceMatch& match) const {
    const std::vector<double> depths = candidate_.map.SceneDepths(candidate_.keyframe);
    if (depths.empty()) return 0.0;
    const Eigen::Vector3d query_in_world =
        Inverse(match.query_from_candidate_world) * Eigen::Vector3d::Zero();
    return (candidate_from_world_ * query_in_world).norm() / depths[depths.size() / 2];
  }

  PlaceRejection Confirm(PlaceMatch& match) const {
    FindGuided(match);
    match.offset_ratio = OffsetRatio(match);
    if (match.offset_ratio > options_.max_offset_ratio) return PlaceRejection::kTooFarAway;
    if (match.num_projected < options_.min_projected) return PlaceRejection::kFewProjected;
    CompareShares(match);
    if (match.mutual_ratio < options_.min_mutual_ratio) return PlaceRejection::kFewFound;
    int asked = 0;
    for (const KeyFrameId id : WithNeighbors(query_.map, query_.keyframe, kWindowMinShared,
                                             options_.confirming_keyframes)) {
      if (id == query_.keyframe) continue;
      const KeyFrame& neighbor = query_.map.keyframe(id);
      const Rigid3d neighbor_from_query =
          neighbor.cam_from_world * Inverse(keyframe_.cam_from_world);
      const Sim3d pose = AsSimilarity(neighbor_from_query) * match.query_from_candidate_world;
      ++asked;
      if (FindPlacePoints(neighbor, pose).num_found >= options_.min_confirming_points) {
        ++match.num_confirming;
      }
    }
    return match.num_confirming < std::min(options_.min_confirming, asked)
               ? PlaceRejection::kNotConfirmed
               : PlaceRejection::kAccepted;
  }

  const PlaceView& query_;
  const PlaceView& candidate_;
  const PlaceVerificationOptions& options_;
  SightingOptions sighting_options_;
  const KeyFrame& keyframe_;
  Rigid3d candidate_from_world_;
  std::vector<KeyFrameId> window_;
  std::vector<MapPointId> place_points_;
};

}  // namespace

std::vector<KeyFrameId> WithNeighbors(const Map& map, KeyFrameId keyframe, int min_shared_points,
                                      int max_neighbors) {
  std::vector<KeyFrameId> ids = {keyframe};
  if (max_neighbors <= 0) return ids;
  for (const auto& neighbor :
       map.covisibility().Neighbors(keyframe, min_shared_points, max_neighbors)) {
    ids.push_back(neighbor.keyframe);
  }
  return ids;
}

PlaceMatch VerifyPlace(const PlaceView& query, const PlaceView& candidate,
                       const PlaceVerificationOptions& options, std::uint64_t seed) {
  return Verifier(query, candidate, options).Run(seed);
}

}  // namespace lift_slam
