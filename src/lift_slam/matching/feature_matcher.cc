#include "lift_slam/matching/feature_matcher.h"

#include <cstdlib>

#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/rotation_consistency.h"

namespace lift_slam {
namespace {

constexpr float kRatio = 0.85F;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// Of each feature of b, the nearest feature of a that chose it.
class BestClaim {
 public:
  explicit BestClaim(int size_b) : claims_(Index(size_b)) {}

  void Offer(int a, int b, float distance) {
    Claim& claim = claims_[Index(b)];
    if (distance < claim.distance) claim = {a, distance};
  }
  bool Holds(int a, int b) const { return claims_[Index(b)].a == a; }

 private:
  struct Claim {
    int a = -1;
    float distance = std::numeric_limits<float>::max();
  };
  std::vector<Claim> claims_;
};

NearestTwo SearchWindow(const FrameFeatures& a, int i, const FrameFeatures& b,
                        const Eigen::Vector2f& center, float radius_px, int level_tolerance) {
  NearestTwo nearest;
  b.ForEachInSquare(center.x(), center.y(), radius_px, [&](int j) {
    if (std::abs(a.level(i) - b.level(j)) > level_tolerance) return;
    nearest.Offer(j, DescriptorDistance(a.descriptor_kind(), a.descriptor(i), b.descriptor(j)));
  });
  return nearest;
}

}  // namespace

std::vector<FeatureMatch> MatchWithinWindow(const FrameFeatures& a, const FrameFeatures& b,
                                            const std::vector<Eigen::Vector2f>& expected_in_b,
                                            float radius_px, const ViewModel& view) {
  std::vector<FeatureMatch> candidates;
  BestClaim claims(b.size());
  for (int i = 0; i < a.size(); ++i) {
    const NearestTwo nearest =
        SearchWindow(a, i, b, expected_in_b[Index(i)], radius_px, view.level_tolerance);
    if (nearest.best < 0 || nearest.best_distance > view.thresholds.fixed.low ||
        !nearest.IsDistinctive(kRatio)) {
      continue;
    }
    candidates.push_back({i, nearest.best});
    claims.Offer(i, nearest.best, nearest.best_distance);
  }
  RotationConsistency rotation;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    rotation.Add(a.keypoint(candidates[k].a).angle_rad, b.keypoint(candidates[k].b).angle_rad,
                 static_cast<int>(k));
  }
  std::vector<char> turned(candidates.size(), 0);
  for (const int k : rotation.Outliers()) turned[Index(k)] = 1;
  std::vector<FeatureMatch> matches;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!turned[k] && claims.Holds(candidates[k].a, candidates[k].b)) {
      matches.push_back(candidates[k]);
    }
  }
  return matches;
}

}  // namespace lift_slam
