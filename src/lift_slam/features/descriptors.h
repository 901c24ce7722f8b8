#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lift_slam {

enum class DescriptorMetric { kHamming, kL2 };

// Who made the descriptors and how they are compared. Descriptors of different kinds are never
// compared: the matcher checks this.
struct DescriptorKind {
  std::string name;  // "orb", or "lift:" and the weights' hash
  DescriptorMetric metric = DescriptorMetric::kHamming;
  int dimension = 0;  // bits for Hamming, floats for L2

  std::size_t BytesPerRow() const;
  friend bool operator==(const DescriptorKind&, const DescriptorKind&) = default;
};

// One descriptor: a view of BytesPerRow() bytes, 8-byte aligned.
using DescriptorView = std::span<const std::byte>;

// Distance between two descriptors of this kind: bits that differ, or the L2 norm of the
// difference (LIFT, paper sec. 3.1; not normalised).
float DescriptorDistance(const DescriptorKind& kind, DescriptorView a, DescriptorView b);

// Rows of descriptors of one kind, packed.
class Descriptors {
 public:
  Descriptors() = default;
  Descriptors(DescriptorKind kind, std::size_t rows);

  const DescriptorKind& kind() const { return kind_; }
  std::size_t size() const { return rows_; }
  DescriptorView row(std::size_t i) const { return {data() + i * stride_, stride_}; }
  std::span<std::byte> mutable_row(std::size_t i) {
    return {mutable_data() + i * stride_, stride_};
  }
  const std::byte* data() const;
  std::byte* mutable_data();

 private:
  DescriptorKind kind_;
  std::size_t rows_ = 0;
  std::size_t stride_ = 0;            // BytesPerRow
  std::vector<std::uint64_t> words_;  // keeps rows 8-byte aligned
};

}  // namespace lift_slam
