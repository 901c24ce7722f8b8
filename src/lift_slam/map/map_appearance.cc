#include <algorithm>
#include <limits>

#include "lift_slam/map/map.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// More observations than this say nothing new about a point's look, and the cost is quadratic.
constexpr std::size_t kMaxCompared = 16;

// The observation whose descriptor has the least median distance to the others.
std::size_t MostTypical(const DescriptorKind& kind, const std::vector<DescriptorView>& views) {
  const std::size_t n = views.size();
  std::vector<float> distances(n * n, 0.0F);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      distances[i * n + j] = distances[j * n + i] = DescriptorDistance(kind, views[i], views[j]);
    }
  }
  std::size_t best = 0;
  float best_median = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = distances.begin() + static_cast<std::ptrdiff_t>(i * n);
    const auto middle = row + static_cast<std::ptrdiff_t>((n - 1) / 2);
    std::nth_element(row, middle, row + static_cast<std::ptrdiff_t>(n));
    if (*middle < best_median) {
      best_median = *middle;
      best = i;
    }
  }
  return best;
}

}  // namespace

void Map::UpdateViewingRange(MapPointId id) {
  MapPoint& updated = point(id);
  LIFT_SLAM_CHECK(!updated.observations.empty(), "point {} is not seen", id.value);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& observation : updated.observations) {
    sum += (updated.position - keyframe(observation.keyframe).Center()).normalized();
  }
  updated.normal = sum.normalized();

  // The level at which the first observer saw it tells at which distances the pyramid covers it.
  const auto& first = updated.observations.front();
  const KeyFrame& reference = keyframe(first.keyframe);
  const double distance = (updated.position - reference.Center()).norm();
  const auto level = static_cast<std::size_t>(reference.features->level(first.feature));
  updated.max_distance = distance * static_cast<double>(view_->scale[level]);
  updated.min_distance = updated.max_distance / static_cast<double>(view_->scale.back());
}

void Map::UpdateAppearance(MapPointId id) {
  UpdateViewingRange(id);
  MapPoint& updated = point(id);
  std::vector<DescriptorView> views;
  const std::size_t n = updated.observations.size();
  for (std::size_t i = n > kMaxCompared ? n - kMaxCompared : 0; i < n; ++i) {
    const auto& observation = updated.observations[i];
    views.push_back(keyframe(observation.keyframe).features->descriptor(observation.feature));
  }
  const auto& kind = keyframe(updated.observations.front().keyframe).features->descriptor_kind();
  const DescriptorView chosen = views[MostTypical(kind, views)];
  updated.descriptor.assign(chosen.begin(), chosen.end());
}

}  // namespace lift_slam
