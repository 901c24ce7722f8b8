#include "lift_slam/features/descriptors.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

std::uint64_t Word(DescriptorView view, std::size_t at) {
  std::uint64_t word;
  std::memcpy(&word, view.data() + at, sizeof word);
  return word;
}

int DifferingBits(DescriptorView a, DescriptorView b, std::size_t at) {
  return std::popcount(Word(a, at) ^ Word(b, at));
}

float HammingDistance(DescriptorView a, DescriptorView b) {
  int bits = 0;
  std::size_t at = 0;
  for (; at + 32 <= a.size(); at += 32) {
    bits += DifferingBits(a, b, at) + DifferingBits(a, b, at + 8) + DifferingBits(a, b, at + 16) +
            DifferingBits(a, b, at + 24);
  }
  for (; at < a.size(); at += 8) bits += DifferingBits(a, b, at);
  return static_cast<float>(bits);
}

float EuclideanDistance(DescriptorView a, DescriptorView b) {
  const auto* fa = reinterpret_cast<const float*>(a.data());
  const auto* fb = reinterpret_cast<const float*>(b.data());
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.size() / sizeof(float); ++i)
    sum += (fa[i] - fb[i]) * (fa[i] - fb[i]);
  return std::sqrt(sum);
}

}  // namespace

std::size_t DescriptorKind::BytesPerRow() const {
  const auto n = static_cast<std::size_t>(dimension);
  return metric == DescriptorMetric::kHamming ? n / 8 : n * sizeof(float);
}

float DescriptorDistance(const DescriptorKind& kind, DescriptorView a, DescriptorView b) {
  return kind.metric == DescriptorMetric::kHamming ? HammingDistance(a, b)
                                                   : EuclideanDistance(a, b);
}

Descriptors::Descriptors(DescriptorKind kind, std::size_t rows)
    : kind_(std::move(kind)), rows_(rows), stride_(kind_.BytesPerRow()) {
  LIFT_SLAM_CHECK(stride_ > 0 && stride_ % 8 == 0, "descriptor '{}' has {} bytes a row", kind_.name,
                  stride_);
  words_.resize(rows * stride_ / 8);
}

const std::byte* Descriptors::data() const {
  return reinterpret_cast<const std::byte*>(words_.data());
}

std::byte* Descriptors::mutable_data() { return reinterpret_cast<std::byte*>(words_.data()); }

}  // namespace lift_slam
