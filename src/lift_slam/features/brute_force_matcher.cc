#include "lift_slam/features/brute_force_matcher.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows whose products with all candidates are held at a time: 128 x 2000 floats fit into the
// second-level cache.
constexpr Eigen::Index kBlockRows = 128;

struct BothWays {
  std::vector<DescriptorNeighbours> of_a, of_b;
};

void Offer(DescriptorNeighbours& neighbours, int candidate, float distance) {
  if (distance < neighbours.best_distance) {
    neighbours.second = std::exchange(neighbours.best, candidate);
    neighbours.second_distance = std::exchange(neighbours.best_distance, distance);
  } else if (distance < neighbours.second_distance) {
    neighbours.second = candidate;
    neighbours.second_distance = distance;
  }
}

Eigen::Map<const RowMatrix> AsMatrix(const Descriptors& descriptors) {
  return {reinterpret_cast<const float*>(descriptors.data()),
          static_cast<Eigen::Index>(descriptors.size()), descriptors.kind().dimension};
}

// The nearest by squared distance, for both sides of each product.
void OfferSquared(const Descriptors& a, const Descriptors& b, BothWays& found) {
  const Eigen::RowVectorXf mean = AsMatrix(b).colwise().mean();
  const RowMatrix centred_a = AsMatrix(a).rowwise() - mean;
  const RowMatrix centred_b = AsMatrix(b).rowwise() - mean;
  const Eigen::VectorXf norms_a = centred_a.rowwise().squaredNorm();
  const Eigen::RowVectorXf norms_b = centred_b.rowwise().squaredNorm().transpose();
  RowMatrix squared;
  for (Eigen::Index begin = 0; begin < centred_a.rows(); begin += kBlockRows) {
    const Eigen::Index rows = std::min(kBlockRows, centred_a.rows() - begin);
    squared.noalias() = -2.0F * centred_a.middleRows(begin, rows) * centred_b.transpose();
    squared.rowwise() += norms_b;
    squared.colwise() += norms_a.segment(begin, rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      DescriptorNeighbours& of_row = found.of_a[static_cast<std::size_t>(begin + i)];
      const float* row = squared.data() + i * squared.cols();
      for (Eigen::Index j = 0; j < squared.cols(); ++j) {
        Offer(of_row, static_cast<int>(j), row[j]);
        Offer(found.of_b[static_cast<std::size_t>(j)], static_cast<int>(begin + i), row[j]);
      }
    }
  }
}

void OfferHamming(const Descriptors& a, const Descriptors& b, BothWays& found) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const float distance = DescriptorDistance(a.kind(), a.row(i), b.row(j));
      Offer(found.of_a[i], static_cast<int>(j), distance);
      Offer(found.of_b[j], static_cast<int>(i), distance);
    }
  }
}

// Distances without the rounding of the products, which may also have put the second first.
void Settle(const Descriptors& queries, const Descriptors& candidates,
            std::vector<DescriptorNeighbours>& neighbours) {
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    DescriptorNeighbours settled;
    for (const int candidate : {std::min(neighbours[i].best, neighbours[i].second),
                                std::max(neighbours[i].best, neighbours[i].second)}) {
      if (candidate < 0) continue;
      const auto row = static_cast<std::size_t>(candidate);
      Offer(settled, candidate,
            DescriptorDistance(queries.kind(), queries.row(i), candidates.row(row)));
    }
    neighbours[i] = settled;
  }
}

BothWays FindBothWays(const Descriptors& a, const Descriptors& b) {
  LIFT_SLAM_CHECK(a.kind() == b.kind(), "'{}' descriptors compared with '{}'", a.kind().name,
                  b.kind().name);
  BothWays found{std::vector<DescriptorNeighbours>(a.size()),
                 std::vector<DescriptorNeighbours>(b.size())};
  if (a.size() == 0 || b.size() == 0) return found;
  if (a.kind().metric == DescriptorMetric::kHamming) {
    OfferHamming(a, b, found);
  } else {
    OfferSquared(a, b, found);
    Settle(a, b, found.of_a);
    Settle(b, a, found.of_b);
  }
  return found;
}

}  // namespace

std::vector<DescriptorNeighbours> FindNearest(const Descriptors& queries,
                                              const Descriptors& candidates) {
  return FindBothWays(queries, candidates).of_a;
}

std::vector<DescriptorMatch> MatchMutualNearest(const Descriptors& a, const Descriptors& b,
                                                float max_ratio) {
  const BothWays found = FindBothWays(a, b);
  std::vector<DescriptorMatch> matches;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const DescriptorNeighbours& of_a = found.of_a[i];
    if (of_a.best < 0) continue;
    const DescriptorNeighbours& of_b = found.of_b[static_cast<std::size_t>(of_a.best)];
    if (of_b.best != static_cast<int>(i)) continue;
    const bool is_distinctive =
        max_ratio >= 1.0F || (of_a.IsDistinctive(max_ratio) && of_b.IsDistinctive(max_ratio));
    if (is_distinctive) matches.push_back({static_cast<int>(i), of_a.best, of_a.best_distance});
  }
  return matches;
}

}  // namespace lift_slam
