#include "lift_slam/place_recognition/cluster_sums.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace lift_slam {
namespace {

// For each byte its eight bits, the lowest first, as numbers.
std::array<std::array<std::int32_t, 8>, 256> MakeBitTable() {
  std::array<std::array<std::int32_t, 8>, 256> table{};
  for (std::size_t byte = 0; byte < 256; ++byte) {
    for (std::size_t bit = 0; bit < 8; ++bit) table[byte][bit] = (byte >> bit) & 1;
  }
  return table;
}

}  // namespace

ClusterSums::ClusterSums(DescriptorKind kind, std::size_t num_clusters)
    : kind_(std::move(kind)),
      dimension_(static_cast<std::size_t>(kind_.dimension)),
      counts_(num_clusters) {
  if (kind_.metric == DescriptorMetric::kHamming) {
    bits_.resize(num_clusters * dimension_);
  } else {
    floats_.resize(num_clusters * dimension_);
  }
}

void ClusterSums::Add(std::size_t cluster, DescriptorView row) {
  ++counts_[cluster];
  if (kind_.metric == DescriptorMetric::kHamming) {
    AddBits(&bits_[cluster * dimension_], row);
    return;
  }
  double* sums = &floats_[cluster * dimension_];
  const auto* values = reinterpret_cast<const float*>(row.data());
  for (std::size_t i = 0; i < dimension_; ++i) sums[i] += static_cast<double>(values[i]);
}

void ClusterSums::AddBits(std::int32_t* sums, DescriptorView row) {
  static const std::array<std::array<std::int32_t, 8>, 256> kBitsOfByte = MakeBitTable();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto& bits = kBitsOfByte[static_cast<std::size_t>(row[i])];
    for (std::size_t k = 0; k < 8; ++k) sums[8 * i + k] += bits[k];
  }
}

void ClusterSums::Add(const ClusterSums& other) {
  const auto add = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  add(counts_, other.counts_);
  add(floats_, other.floats_);
  add(bits_, other.bits_);
}

void ClusterSums::WriteCenter(std::size_t cluster, Descriptors& centers) const {
  if (counts_[cluster] == 0) return;
  const std::span<std::byte> center = centers.mutable_row(cluster);
  if (kind_.metric == DescriptorMetric::kHamming) {
    std::fill(center.begin(), center.end(), std::byte{0});
    for (std::size_t i = 0; i < dimension_; ++i) {
      const auto set = static_cast<std::size_t>(bits_[cluster * dimension_ + i]);
      if (2 * set > counts_[cluster]) center[i / 8] |= std::byte{1} << (i % 8);
    }
    return;
  }
  auto* values = reinterpret_cast<float*>(center.data());
  for (std::size_t i = 0; i < dimension_; ++i) {
    values[i] = static_cast<float>(floats_[cluster * dimension_ + i] /
                                   static_cast<double>(counts_[cluster]));
  }
}

}  // namespace lift_slam
