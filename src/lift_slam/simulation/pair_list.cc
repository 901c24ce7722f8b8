#include "lift_slam/simulation/pair_list.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "lift_slam/simulation/motion/band_noise.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kGridCells = 40;  // along the image's longer side
constexpr double kMaxDepthDifference = 0.03;
constexpr std::uint64_t kPairStream = 400;

double Degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

float DepthAt(const DepthImage& depth, int x, int y) {
  return depth.depth_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.width) +
                       static_cast<std::size_t>(x)];
}

// Whether the other frame sees a point where its own depth says so.
bool Sees(const Camera& camera, const DepthImage& depth, const Eigen::Vector3d& x_in_cam) {
  const auto pixel = camera.Project(x_in_cam);
  if (!pixel) return false;
  const auto x = static_cast<int>(std::lround(pixel->x()));
  const auto y = static_cast<int>(std::lround(pixel->y()));
  if (x < 0 || y < 0 || x >= depth.width || y >= depth.height) return false;
  return std::abs(DepthAt(depth, x, y) - x_in_cam.z()) < kMaxDepthDifference * x_in_cam.z();
}

// Depth images of late use, so that neighbours need not be read again.
class DepthCache {
 public:
  explicit DepthCache(const std::function<DepthImage(int)>& read) : read_(read) {}

  const DepthImage& Get(int frame) {
    auto [entry, is_new] = images_.try_emplace(frame);
    if (is_new) {
      entry->second = read_(frame);
      order_.push_back(frame);
    }
    return entry->second;
  }
  // Forgets the oldest; what Get returned before is no longer valid.
  void Trim() {
    constexpr std::size_t kCapacity = 60;
    if (order_.size() <= kCapacity) return;
    const std::size_t surplus = order_.size() - kCapacity;
    for (std::size_t i = 0; i < surplus; ++i) images_.erase(order_[i]);
    order_.erase(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(surplus));
  }

 private:
  const std::function<DepthImage(int)>& read_;
  std::map<int, DepthImage> images_;
  std::vector<int> order_;
};

FramePair Relate(const std::vector<Rigid3d>& poses, int first, int second) {
  const Rigid3d& a = poses[static_cast<std::size_t>(first)];
  const Rigid3d& b = poses[static_cast<std::size_t>(second)];
  return {first, second, (a.translation - b.translation).norm(),
          Degrees(RotationAngle(a.rotation.conjugate() * b.rotation)), 0.0};
}

// The later frames near enough to `first`, a seeded choice of them, in order.
std::vector<FramePair> Candidates(const std::vector<Rigid3d>& poses, int first,
                                  const PairOptions& options, std::uint64_t seed) {
  std::vector<FramePair> near;
  for (int second = first + 1; second < static_cast<int>(poses.size()); ++second) {
    const FramePair pair = Relate(poses, first, second);
    if (pair.distance_m <= options.max_distance_m && pair.angle_deg <= options.max_angle_deg) {
      near.push_back(pair);
    }
  }
  Random random(MixSeeds(MixSeeds(seed, kPairStream), static_cast<std::uint64_t>(first)));
  while (near.size() > static_cast<std::size_t>(options.max_pairs_per_frame)) {
    near.erase(near.begin() + random.UniformInt(0, static_cast<int>(near.size()) - 1));
  }
  return near;
}

}  // namespace

void PairOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_distance_m", max_distance_m, "between the two cameras");
  visitor.Field("max_angle_deg", max_angle_deg, "of the relative rotation");
  visitor.Field("min_overlap", min_overlap, "share of each image that the other sees");
  visitor.Field("max_pairs_per_frame", max_pairs_per_frame, "with later frames");
}

void PairOptions::Check() const {
  if (!(max_distance_m >= 0.0) || !(max_angle_deg >= 0.0) || !(min_overlap >= 0.0) ||
      min_overlap > 1.0 || max_pairs_per_frame < 1) {
    throw InputError(fmt::format(
        "pair_limits: max_distance_m is {}, max_angle_deg {}, min_overlap {}, max_pairs_per_frame "
        "{}; expected 0 or more, an overlap of at most 1 and at least 1 pair",
        max_distance_m, max_angle_deg, min_overlap, max_pairs_per_frame));
  }
}

double Overlap(const Camera& camera, const DepthImage& depth, const Rigid3d& cam_from_world,
               const DepthImage& other_depth, const Rigid3d& other_from_world) {
  const Rigid3d other_from_cam = other_from_world * Inverse(cam_from_world);
  const int step = std::max(1, std::max(depth.width, depth.height) / kGridCells);
  int seen = 0, total = 0;
  for (int y = step / 2; y < depth.height; y += step) {
    for (int x = step / 2; x < depth.width; x += step, ++total) {
      const double z = DepthAt(depth, x, y);
      if (z <= 0.0) continue;
      const auto ray = camera.Unproject({x, y});
      if (!ray || ray->z() <= 0.0) continue;
      seen += Sees(camera, other_depth, other_from_cam * (*ray * (z / ray->z()))) ? 1 : 0;
    }
  }
  return total > 0 ? static_cast<double>(seen) / total : 0.0;
}

std::vector<FramePair> ListPairs(const Camera& camera, const std::vector<Rigid3d>& world_from_cam,
                                 const std::function<DepthImage(int)>& read_depth,
                                 const PairOptions& options, std::uint64_t seed) {
  DepthCache cache(read_depth);
  std::vector<FramePair> pairs;
  for (int first = 0; first < static_cast<int>(world_from_cam.size()); ++first) {
    for (FramePair& pair : Candidates(world_from_cam, first, options, seed)) {
      const Rigid3d a = Inverse(world_from_cam[static_cast<std::size_t>(first)]);
      const Rigid3d b = Inverse(world_from_cam[static_cast<std::size_t>(pair.second)]);
      const DepthImage& depth = cache.Get(first);
      const DepthImage& other = cache.Get(pair.second);
      pair.overlap =
          std::min(Overlap(camera, depth, a, other, b), Overlap(camera, other, b, depth, a));
      if (pair.overlap >= options.min_overlap) pairs.push_back(pair);
    }
    cache.Trim();
  }
  return pairs;
}

std::string PairsText(const std::vector<FramePair>& pairs) {
  std::string text = "# first second distance_m angle_deg overlap\n";
  for (const FramePair& pair : pairs) {
    text += fmt::format("{} {} {:.4f} {:.3f} {:.3f}\n", pair.first, pair.second, pair.distance_m,
                        pair.angle_deg, pair.overlap);
  }
  return text;
}

}  // namespace lift_slam
