#include "lift_slam/loop_closing/word_matching.h"

#include <algorithm>
#include <limits>

#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/rotation_consistency.h"

namespace lift_slam {
namespace {

constexpr float kMaxRatio = 0.75F;  // nearest over second nearest, as without any prediction

using Group = std::span<const std::uint32_t>;

// For each feature of b the feature of a that claims it, and the distance.
struct Claims {
  explicit Claims(int num_features)
      : owner(static_cast<std::size_t>(num_features), -1),
        distance(static_cast<std::size_t>(num_features), std::numeric_limits<float>::max()) {}
  std::vector<int> owner;
  std::vector<float> distance;
};

void MatchGroup(const KeyFrame& a, Group group_a, const KeyFrame& b, Group group_b,
                float max_distance, Claims& claims) {
  const DescriptorKind& kind = a.features->descriptor_kind();
  for (const std::uint32_t i : group_a) {
    NearestTwo nearest;
    for (const std::uint32_t j : group_b) {
      if (!b.map_points[j].valid()) continue;
      nearest.Offer(static_cast<int>(j),
                    DescriptorDistance(kind, a.features->descriptor(static_cast<int>(i)),
                                       b.features->descriptor(static_cast<int>(j))));
    }
    if (nearest.best < 0 || nearest.best_distance > max_distance) continue;
    if (!nearest.IsDistinctive(kMaxRatio)) continue;
    const auto best = static_cast<std::size_t>(nearest.best);
    if (nearest.best_distance >= claims.distance[best]) continue;
    claims.owner[best] = static_cast<int>(i);
    claims.distance[best] = nearest.best_distance;
  }
}

}  // namespace

std::vector<FeatureMatch> MatchPointsByWords(const KeyFrame& a, const DirectIndex& a_words,
                                             const KeyFrame& b, const DirectIndex& b_words,
                                             float max_distance) {
  Claims claims(b.features->size());
  ForEachSharedNode(a_words, b_words, [&](Group group_a, Group group_b) {
    MatchGroup(a, group_a, b, group_b, max_distance, claims);
  });
  std::vector<FeatureMatch> matches;
  for (int j = 0; j < b.features->size(); ++j) {
    const int i = claims.owner[static_cast<std::size_t>(j)];
    if (i >= 0) matches.push_back({i, j});
  }
  std::sort(matches.begin(), matches.end(),
            [](const FeatureMatch& x, const FeatureMatch& y) { return x.a < y.a; });
  RotationConsistency rotation;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    rotation.Add(a.features->keypoint(matches[k].a).angle_rad,
                 b.features->keypoint(matches[k].b).angle_rad, static_cast<int>(k));
  }
  for (const int k : rotation.Outliers()) matches[static_cast<std::size_t>(k)].a = -1;
  std::erase_if(matches, [](const FeatureMatch& match) { return match.a < 0; });
  return matches;
}

}  // namespace lift_slam
