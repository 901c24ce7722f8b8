#include "lift_slam/evaluation/kitti_error.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace lift_slam {
namespace {

constexpr double kLengthsM[] = {100, 200, 300, 400, 500, 600, 700, 800};
constexpr std::size_t kFirstFrameStep = 10;

struct Segment {
  double translation_error = 0.0;  // metres per metre
  double rotation_error_rad_per_m = 0.0;
};

// E = (E_f^-1 E_l)^-1 (G_f^-1 G_l). The angle of E equals the benchmark's
// acos((trace - 1) / 2), without its loss of digits near 0.
Segment CompareSegment(const PosePair& first, const PosePair& last, double length_m) {
  const Rigid3d reference_motion = Inverse(first.reference) * last.reference;
  const Rigid3d estimate_motion = Inverse(first.estimate) * last.estimate;
  const Rigid3d error = Inverse(estimate_motion) * reference_motion;
  return {error.translation.norm() / length_m, RotationAngle(error.rotation) / length_m};
}

SegmentErrors Mean(std::span<const Segment> segments) {
  SegmentErrors errors;
  errors.num_segments = static_cast<int>(segments.size());
  for (const Segment& segment : segments) {
    errors.translation_pct += 100.0 * segment.translation_error;
    errors.rotation_deg_per_m += segment.rotation_error_rad_per_m * 180.0 / std::numbers::pi;
  }
  if (segments.empty()) return errors;
  errors.translation_pct /= static_cast<double>(segments.size());
  errors.rotation_deg_per_m /= static_cast<double>(segments.size());
  return errors;
}

std::vector<Segment> SegmentsOfLength(double length_m, const std::vector<double>& path_m,
                                      const std::vector<const PosePair*>& pair_of_frame) {
  std::vector<Segment> segments;
  for (std::size_t first = 0; first < path_m.size(); first += kFirstFrameStep) {
    const auto end = std::upper_bound(path_m.begin() + static_cast<std::ptrdiff_t>(first),
                                      path_m.end(), path_m[first] + length_m);
    if (end == path_m.end()) break;
    const auto last = static_cast<std::size_t>(end - path_m.begin());
    if (pair_of_frame[first] == nullptr || pair_of_frame[last] == nullptr) continue;
    segments.push_back(CompareSegment(*pair_of_frame[first], *pair_of_frame[last], length_m));
  }
  return segments;
}

}  // namespace

std::vector<double> CumulativePathLength(const Trajectory& trajectory) {
  std::vector<double> path_m(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    path_m[i] = path_m[i - 1] + (trajectory[i].world_from_cam.translation -
                                 trajectory[i - 1].world_from_cam.translation)
                                    .norm();
  }
  return path_m;
}

KittiError ComputeKittiError(const Trajectory& reference, std::span<const PosePair> aligned) {
  std::vector<const PosePair*> pair_of_frame(reference.size(), nullptr);
  for (const PosePair& pair : aligned) pair_of_frame[pair.reference_index] = &pair;
  const std::vector<double> path_m = CumulativePathLength(reference);
  KittiError result;
  std::vector<Segment> all;
  for (const double length_m : kLengthsM) {
    const std::vector<Segment> segments = SegmentsOfLength(length_m, path_m, pair_of_frame);
    result.by_length.push_back({length_m, Mean(segments)});
    all.insert(all.end(), segments.begin(), segments.end());
  }
  result.all = Mean(all);
  return result;
}

}  // namespace lift_slam
