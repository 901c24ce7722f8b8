#include "lift_slam/local_mapping/point_creation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/local_mapping/repetition_check.h"
#include "lift_slam/matching/observation_alignment.h"

namespace lift_slam {
namespace {

// The ratio of a point's distances must fit the ratio of the levels within this factor times one
// level's scale.
constexpr double kScaleSlack = 1.5;
// Points nearer than this share of the near end of the scene are not looked for.
constexpr double kNearShare = 0.3;
constexpr double kNearQuantile = 0.02;

struct SceneDepth {
  double near = 0.0, median = 0.0;
};

std::optional<SceneDepth> MeasureDepth(const Map& map, KeyFrameId keyframe) {
  const std::vector<double> depths = map.SceneDepths(keyframe);
  if (depths.empty() || depths[depths.size() / 2] <= 0.0) return std::nullopt;
  const double median = depths[depths.size() / 2];
  const auto near = static_cast<std::size_t>(kNearQuantile * static_cast<double>(depths.size()));
  return SceneDepth{kNearShare * std::max(depths[near], 0.02 * median), median};
}

class PairTriangulator {
 public:
  PairTriangulator(const Map& map, const KeyFrame& a, const KeyFrame& b,
                   const LocalMapperOptions& options)
      : view_(map.view()),
        a_(a),
        b_(b),
        b_from_a_(b.cam_from_world * Inverse(a.cam_from_world)),
        max_cosine_(std::cos(options.min_parallax_deg * std::numbers::pi / 180.0)) {}

  // World position of the match's point; nothing when a check refuses it.
  std::optional<Eigen::Vector3d> Triangulate(const FeatureMatch& match) const {
    return Triangulate(match, b_.features->pixel(match.b));
  }

  // The same with another pixel in b.
  std::optional<Eigen::Vector3d> Triangulate(const FeatureMatch& match,
                                             const Eigen::Vector2d& pixel_b) const {
    const Eigen::Vector3d ray_a = view_.pinhole.Unproject(a_.features->pixel(match.a));
    const Eigen::Vector3d ray_b = view_.pinhole.Unproject(pixel_b);
    const double cosine = (b_from_a_.rotation * ray_a).dot(ray_b) / (ray_a.norm() * ray_b.norm());
    if (cosine <= 0.0 || cosine >= max_cosine_) return std::nullopt;
    const auto in_a = TriangulatePoint(b_from_a_, ray_a.head<2>(), ray_b.head<2>());
    if (!in_a || !ReprojectsWell(*in_a, a_, match.a, a_.features->pixel(match.a))) {
      return std::nullopt;
    }
    const Eigen::Vector3d in_b = b_from_a_ * *in_a;
    if (!ReprojectsWell(in_b, b_, match.b, pixel_b) || !ScaleFits(*in_a, in_b, match))
      return std::nullopt;
    return Inverse(a_.cam_from_world) * *in_a;
  }

 private:
  bool ReprojectsWell(const Eigen::Vector3d& in_cam, const KeyFrame& keyframe, int feature,
                      const Eigen::Vector2d& pixel) const {
    if (in_cam.z() <= 0.0) return false;
    const double squared = (view_.pinhole.Project(in_cam) - pixel).squaredNorm();
    const auto level = static_cast<std::size_t>(keyframe.features->level(feature));
    return squared * view_.inverse_variance[level] <= kChiSquare95With2Dof;
  }

  bool ScaleFits(const Eigen::Vector3d& in_a, const Eigen::Vector3d& in_b,
                 const FeatureMatch& match) const {
    // A point twice as far away is found on a level of half the scale: the product stays the same.
    const auto scale = [&](const KeyFrame& keyframe, int feature) {
      const auto level = static_cast<std::size_t>(keyframe.features->level(feature));
      return static_cast<double>(view_.scale[level]);
    };
    const double ratio = (in_a.norm() * scale(a_, match.a)) / (in_b.norm() * scale(b_, match.b));
    const double factor = kScaleSlack * view_.levels.scale_factor;
    return ratio < factor && ratio > 1.0 / factor;
  }

  const ViewModel& view_;
  const KeyFrame& a_;
  const KeyFrame& b_;
  Rigid3d b_from_a_;
  double max_cosine_;
};

// Aligns the point's observation in the other keyframe to its patch in the keyframe. False when the
// point at the aligned pixels fails a check it had passed at the detected ones.
bool AlignNewPoint(const PairTriangulator& triangulator, const FeatureMatch& match,
                   KeyFrameId keyframe, KeyFrameId other, MapPointId id, Map& map) {
  AnchorPoint(id, keyframe, map);
  if (!AlignObservation(id, other, map)) return true;
  MapPoint& point = map.point(id);
  const auto seen = std::ranges::find(point.observations, other, &MapPoint::Observation::keyframe);
  const auto position = triangulator.Triangulate(match, seen->pixel.cast<double>());
  if (position) point.position = *position;
  return position.has_value();
}

// What the new keyframe is matched against its neighbours with.
struct Creation {
  const LocalMapperOptions& options;
  float max_distance;
  SceneDepth depth;
  RepetitionCheck repetition;
  std::vector<MapPointId> created;
};

void CreateFromPair(KeyFrameId keyframe_id, KeyFrameId other_id, Creation& creation, Map& map) {
  const KeyFrame &keyframe = map.keyframe(keyframe_id), &other = map.keyframe(other_id);
  const double baseline = (keyframe.Center() - other.Center()).norm();
  if (baseline < creation.options.min_baseline_ratio * creation.depth.median) return;
  const PairTriangulator triangulator(map, keyframe, other, creation.options);
  for (const FeatureMatch& match :
       MatchAlongEpipolarLines(keyframe, other, creation.depth.near, creation.max_distance,
                               map.view(), creation.options.epipolar)) {
    const auto position = triangulator.Triangulate(match);
    if (!position || creation.repetition.IsRepetitive(match.a, other)) continue;
    const MapPointId point = map.AddPoint(*position, keyframe_id);
    map.AddObservation(point, keyframe_id, match.a);
    map.AddObservation(point, other_id, match.b);
    if (!AlignNewPoint(triangulator, match, keyframe_id, other_id, point, map)) {
      map.ErasePoint(point);
      continue;
    }
    map.UpdateAppearance(point);
    creation.created.push_back(point);
  }
}

int CountPoints(const KeyFrame& keyframe) {
  return static_cast<int>(std::ranges::count_if(keyframe.map_points, &MapPointId::valid));
}

}  // namespace

std::vector<MapPointId> CreatePoints(KeyFrameId keyframe_id, const LocalMapperOptions& options,
                                     float max_distance, Map& map) {
  const auto depth = MeasureDepth(map, keyframe_id);
  if (!depth) return {};
  const KeyFrame& keyframe = map.keyframe(keyframe_id);
  Creation creation{options,
                    max_distance,
                    *depth,
                    RepetitionCheck(map, keyframe, options.max_self_similarity),
                    {}};
  auto neighbors = map.covisibility().Neighbors(keyframe_id, 1, options.triangulation_neighbors);
  // The widest baselines first: a point made from them is surer than one made from a near pair,
  // and its feature is then taken.
  std::reverse(neighbors.begin(), neighbors.end());
  for (const auto& neighbor : neighbors) {
    CreateFromPair(keyframe_id, neighbor.keyframe, creation, map);
  }
  // Little else to see: points that may be wrong are better than to be lost. But not what looks the
  // same all along the line, such as a crash barrier.
  creation.repetition.Relax(options.max_self_similarity_of_few);
  for (const auto& neighbor : neighbors) {
    if (CountPoints(keyframe) >= options.min_unique_points) break;
    CreateFromPair(keyframe_id, neighbor.keyframe, creation, map);
  }
  return creation.created;
}

}  // namespace lift_slam
