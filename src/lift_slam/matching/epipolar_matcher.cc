#include "lift_slam/matching/epipolar_matcher.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/rotation_consistency.h"

namespace lift_slam {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// The part of an epipolar line in b on which a feature of a can lie.
struct EpipolarSegment {
  Eigen::Vector2f near, far;  // pixels at the least depth and at infinity, clipped to the image
  Eigen::Vector2d normal;     // unit normal of the line
  double offset = 0.0;        // normal . pixel + offset = signed distance

  double Distance(const Eigen::Vector2d& pixel) const {
    return std::abs(normal.dot(pixel) + offset);
  }
};

class EpipolarGeometry {
 public:
  EpipolarGeometry(const KeyFrame& a, const KeyFrame& b, double min_depth, const ViewModel& view)
      : view_(view),
        b_from_a_(b.cam_from_world * Inverse(a.cam_from_world)),
        rotation_(b_from_a_.RotationMatrix()),
        min_depth_(min_depth) {
    if (b_from_a_.translation.z() > 1e-9) epipole_ = view.pinhole.Project(b_from_a_.translation);
  }

  bool NearEpipole(const Eigen::Vector2d& pixel, double distance_px) const {
    return epipole_ && (*epipole_ - pixel).squaredNorm() < distance_px * distance_px;
  }

  std::optional<EpipolarSegment> SegmentOf(const Eigen::Vector2d& pixel_in_a) const {
    const Eigen::Vector3d direction = rotation_ * view_.pinhole.Unproject(pixel_in_a);
    // Points of the ray in b: direction * depth + translation; both ends must lie before b.
    constexpr double kMinZ = 1e-3;
    if (direction.z() < kMinZ) return std::nullopt;
    double depth = min_depth_;
    const double z = direction.z() * depth + b_from_a_.translation.z();
    if (z < kMinZ * depth) depth = -b_from_a_.translation.z() / direction.z() * 1.05;
    const Eigen::Vector2d near = view_.pinhole.Project(direction * depth + b_from_a_.translation);
    const Eigen::Vector2d far = view_.pinhole.Project(direction);
    const Eigen::Vector2d along = near - far;
    if (along.norm() < 1e-6) return std::nullopt;
    EpipolarSegment segment;
    segment.normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
    segment.offset = -segment.normal.dot(far);
    return Clip(far, near, segment);
  }

 private:
  // Cuts the segment to the image's rectangle (Liang-Barsky); nothing when it lies outside.
  std::optional<EpipolarSegment> Clip(const Eigen::Vector2d& far, const Eigen::Vector2d& near,
                                      EpipolarSegment segment) const {
    const Eigen::Vector2d d = near - far;
    double t0 = 0.0, t1 = 1.0;
    const auto cut = [&](double p, double q) {
      if (p == 0.0) return q >= 0.0;
      const double t = q / p;
      if (p < 0.0) t0 = std::max(t0, t);
      if (p > 0.0) t1 = std::min(t1, t);
      return t0 <= t1;
    };
    if (!cut(-d.x(), far.x() - view_.min_x) || !cut(d.x(), view_.max_x - far.x()) ||
        !cut(-d.y(), far.y() - view_.min_y) || !cut(d.y(), view_.max_y - far.y())) {
      return std::nullopt;
    }
    segment.far = (far + t0 * d).cast<float>();
    segment.near = (far + t1 * d).cast<float>();
    return segment;
  }

  const ViewModel& view_;
  Rigid3d b_from_a_;
  Eigen::Matrix3d rotation_;
  double min_depth_;
  std::optional<Eigen::Vector2d> epipole_;  // in b, when before b's camera
};

bool LevelsFit(int level_a, int level_b, const ViewModel& view) {
  return std::abs(level_a - level_b) <= view.level_tolerance + 1;
}

// Features of b with map points as well: one of them may be the right one, and then no other is.
NearestTwo SearchSegment(const KeyFrame& a, int i, const KeyFrame& b,
                         const EpipolarGeometry& geometry, const EpipolarSegment& segment,
                         const ViewModel& view, const EpipolarMatchOptions& options) {
  const FrameFeatures& features = *b.features;
  const auto max_error = static_cast<float>(options.max_epipolar_error_px);
  NearestTwo nearest;
  features.ForEachNearSegment(segment.far, segment.near, max_error, [&](int j) {
    if (!LevelsFit(features.level(j), a.features->level(i), view)) return;
    const Eigen::Vector2d pixel = features.pixel(j);
    const double scale = view.scale[Index(features.level(j))];
    if (segment.Distance(pixel) > options.max_epipolar_error_px * scale) return;
    if (geometry.NearEpipole(pixel, options.min_epipole_distance_px * scale)) return;
    nearest.Offer(j, DescriptorDistance(features.descriptor_kind(), a.features->descriptor(i),
                                        features.descriptor(j)));
  });
  return nearest;
}

// Keeps, of the matches to one feature of b, the one with the least distance, and drops those
// that turn against the rest.
std::vector<FeatureMatch> Consistent(const std::vector<FeatureMatch>& matches,
                                     const std::vector<float>& distances, const KeyFrame& a,
                                     const KeyFrame& b) {
  std::vector<int> best_of_b(Index(b.features->size()), -1);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    int& best = best_of_b[Index(matches[k].b)];
    if (best < 0 || distances[k] < distances[Index(best)]) best = static_cast<int>(k);
  }
  RotationConsistency rotation;
  std::vector<char> kept(matches.size(), 0);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (best_of_b[Index(matches[k].b)] != static_cast<int>(k)) continue;
    kept[k] = 1;
    rotation.Add(a.features->keypoint(matches[k].a).angle_rad,
                 b.features->keypoint(matches[k].b).angle_rad, static_cast<int>(k));
  }
  for (const int k : rotation.Outliers()) kept[Index(k)] = 0;
  std::vector<FeatureMatch> consistent;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (kept[k]) consistent.push_back(matches[k]);
  }
  return consistent;
}

}  // namespace

std::vector<FeatureMatch> MatchAlongEpipolarLines(const KeyFrame& a, const KeyFrame& b,
                                                  double min_depth, float max_distance,
                                                  const ViewModel& view,
                                                  const EpipolarMatchOptions& options) {
  const EpipolarGeometry geometry(a, b, min_depth, view);
  const bool is_binary = a.features->descriptor_kind().metric == DescriptorMetric::kHamming;
  const auto ratio = static_cast<float>(is_binary ? options.max_descriptor_ratio
                                                  : options.max_descriptor_ratio_of_floats);
  std::vector<FeatureMatch> matches;
  std::vector<float> distances;
  for (int i = 0; i < a.features->size(); ++i) {
    if (a.map_points[Index(i)].valid()) continue;
    const auto segment = geometry.SegmentOf(a.features->pixel(i));
    if (!segment) continue;
    const NearestTwo nearest = SearchSegment(a, i, b, geometry, *segment, view, options);
    if (nearest.best < 0 || b.map_points[Index(nearest.best)].valid() ||
        nearest.best_distance > max_distance || !nearest.IsDistinctive(ratio)) {
      continue;
    }
    matches.push_back({i, nearest.best});
    distances.push_back(nearest.best_distance);
  }
  return Consistent(matches, distances, a, b);
}

}  // namespace lift_slam
