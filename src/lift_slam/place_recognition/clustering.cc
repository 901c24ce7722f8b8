#include "lift_slam/place_recognition/clustering.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "lift_slam/place_recognition/cluster_sums.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/parallel_for.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// Rows that one task of a thread takes; sums of chunks are added in order, so that the result does
// not depend on the number of threads.
constexpr std::size_t kChunkRows = 2048;
// Rows that compete to become the next first center.
constexpr int kDrawnCenters = 3;

float SquaredDistance(const DescriptorKind& kind, DescriptorView a, DescriptorView b) {
  if (kind.metric == DescriptorMetric::kHamming) return DescriptorDistance(kind, a, b);
  using Row = Eigen::Map<const Eigen::VectorXf>;
  const Eigen::Index n = kind.dimension;
  return (Row(reinterpret_cast<const float*>(a.data()), n) -
          Row(reinterpret_cast<const float*>(b.data()), n))
      .squaredNorm();
}

class Clusterer {
 public:
  Clusterer(const Descriptors& rows, const ClusteringOptions& options, std::uint64_t seed)
      : rows_(rows),
        options_(options),
        random_(seed),
        centers_(rows.kind(), 0),
        assignment_(rows.size(), kUnassigned) {}

  Clustering Run() {
    ChooseCenters();
    for (int i = 0; i < options_.max_iterations && Assign() > 0; ++i) UpdateCenters();
    Assign();
    DropEmptyClusters();
    return {std::move(centers_), std::move(assignment_)};
  }

 private:
  static constexpr std::uint8_t kUnassigned = 255;

  std::size_t num_chunks() const { return (rows_.size() + kChunkRows - 1) / kChunkRows; }

  // work(chunk, first row, end row)
  template <class Work>
  void ForEachChunk(Work&& work) const {
    ParallelFor(num_chunks(), options_.num_threads, [&](std::size_t chunk) {
      work(chunk, chunk * kChunkRows, std::min(rows_.size(), (chunk + 1) * kChunkRows));
    });
  }

  // Greedy k-means++: each next center is, of some rows drawn with a chance in proportion to their
  // squared distance from the nearest center so far, the one that lowers the sum of these most.
  void ChooseCenters() {
    std::vector<float> cost(rows_.size(), std::numeric_limits<float>::max());
    std::vector<std::size_t> chosen = {
        static_cast<std::size_t>(random_.UniformInt(0, static_cast<int>(rows_.size()) - 1))};
    double total = LowerCosts(chosen[0], cost);
    while (static_cast<int>(chosen.size()) < options_.num_clusters && total > 0.0) {
      chosen.push_back(AddBestOfDrawn(cost, total));
    }
    centers_ = Descriptors(rows_.kind(), chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) SetCenter(i, rows_.row(chosen[i]));
  }

  std::size_t AddBestOfDrawn(std::vector<float>& cost, double& total) {
    std::size_t best = 0;
    double best_total = std::numeric_limits<double>::infinity();
    std::vector<float> best_cost, trial_cost;
    for (int i = 0; i < kDrawnCenters; ++i) {
      const std::size_t row = Draw(cost, total);
      trial_cost = cost;
      const double trial_total = LowerCosts(row, trial_cost);
      if (!(trial_total < best_total)) continue;
      best = row;
      best_total = trial_total;
      std::swap(best_cost, trial_cost);
    }
    cost = std::move(best_cost);
    total = best_total;
    return best;
  }

  // Takes the distances from one more center into account; returns the sum of the costs.
  double LowerCosts(std::size_t center, std::vector<float>& cost) const {
    std::vector<double> sums(num_chunks());
    ForEachChunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        cost[i] = std::min(cost[i], SquaredDistance(rows_.kind(), rows_.row(i), rows_.row(center)));
        sum += static_cast<double>(cost[i]);
      }
      sums[chunk] = sum;
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  std::size_t Draw(const std::vector<float>& cost, double total) {
    double left = random_.Uniform() * total;
    std::size_t last = 0;
    for (std::size_t i = 0; i < cost.size(); ++i) {
      if (!(cost[i] > 0.0F)) continue;
      last = i;
      left -= static_cast<double>(cost[i]);
      if (left < 0.0) break;
    }
    return last;
  }

  void SetCenter(std::size_t i, DescriptorView value) {
    std::memcpy(centers_.mutable_row(i).data(), value.data(), value.size());
  }

  // Returns how many rows changed their cluster.
  std::size_t Assign() {
    std::vector<std::size_t> changes(num_chunks());
    ForEachChunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint8_t nearest = NearestCenter(centers_, rows_.row(i));
        changes[chunk] += nearest != assignment_[i];
        assignment_[i] = nearest;
      }
    });
    std::size_t total = 0;
    for (const std::size_t count : changes) total += count;
    return total;
  }

  // A center without rows stays where it is.
  void UpdateCenters() {
    std::vector<ClusterSums> sums(num_chunks(), ClusterSums(rows_.kind(), centers_.size()));
    ForEachChunk([&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sums[chunk].Add(assignment_[i], rows_.row(i));
    });
    for (std::size_t chunk = 1; chunk < sums.size(); ++chunk) sums[0].Add(sums[chunk]);
    for (std::size_t i = 0; i < centers_.size(); ++i) sums[0].WriteCenter(i, centers_);
  }

  void DropEmptyClusters() {
    std::vector<std::size_t> count(centers_.size());
    for (const std::uint8_t cluster : assignment_) ++count[cluster];
    std::vector<std::uint8_t> new_index(centers_.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      if (count[i] == 0) continue;
      new_index[i] = static_cast<std::uint8_t>(kept);
      if (kept != i) SetCenter(kept, centers_.row(i));
      ++kept;
    }
    for (std::uint8_t& cluster : assignment_) cluster = new_index[cluster];
    Descriptors full(centers_.kind(), kept);
    for (std::size_t i = 0; i < kept; ++i) {
      std::memcpy(full.mutable_row(i).data(), centers_.row(i).data(), centers_.row(i).size());
    }
    centers_ = std::move(full);
  }

  const Descriptors& rows_;
  const ClusteringOptions& options_;
  Random random_;
  Descriptors centers_;
  std::vector<std::uint8_t> assignment_;
};

}  // namespace

std::uint8_t NearestCenter(const Descriptors& centers, DescriptorView row) {
  std::uint8_t nearest = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const float distance = SquaredDistance(centers.kind(), centers.row(i), row);
    if (!(distance < least)) continue;
    least = distance;
    nearest = static_cast<std::uint8_t>(i);
  }
  return nearest;
}

Clustering ClusterDescriptors(const Descriptors& rows, const ClusteringOptions& options,
                              std::uint64_t seed) {
  LIFT_SLAM_CHECK(options.num_clusters >= 1 && options.num_clusters < 255, "{} clusters",
                  options.num_clusters);
  LIFT_SLAM_CHECK(rows.size() > 0 && rows.size() < std::numeric_limits<int>::max(), "{} rows",
                  rows.size());
  return Clusterer(rows, options, seed).Run();
}

}  // namespace lift_slam
