#include "benchmarks/place_recognition/vlad.h"

#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

std::vector<float> Values(const DescriptorKind& kind, DescriptorView row) {
  std::vector<float> values(static_cast<std::size_t>(kind.dimension));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_set = kind.metric == DescriptorMetric::kHamming &&
                        ((row[i / 8] >> (i % 8)) & std::byte{1}) != std::byte{0};
    values[i] = kind.metric == DescriptorMetric::kL2 ? reinterpret_cast<const float*>(row.data())[i]
                                                     : (is_set ? 1.0F : -1.0F);
  }
  return values;
}

void Normalize(std::span<float> values) {
  float squares = 0.0F;
  for (const float value : values) squares += value * value;
  if (!(squares > 0.0F)) return;
  for (float& value : values) value /= std::sqrt(squares);
}

}  // namespace

VladAggregator::VladAggregator(const Vocabulary& vocabulary) : vocabulary_(vocabulary) {
  const Descriptors centers = vocabulary.Centers(vocabulary.direct_nodes());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    centers_.push_back(Values(centers.kind(), centers.row(i)));
  }
}

std::size_t VladAggregator::dimension() const { return centers_.size() * centers_[0].size(); }

std::vector<float> VladAggregator::Aggregate(const Descriptors& descriptors) const {
  const std::vector<std::uint32_t>& nodes = vocabulary_.direct_nodes();
  const std::size_t width = centers_[0].size();
  std::vector<float> sum(dimension());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const std::uint32_t node = vocabulary_.Find(descriptors.row(i)).direct_node;
    const auto place = static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                                nodes.begin());
    const std::vector<float> values = Values(descriptors.kind(), descriptors.row(i));
    for (std::size_t k = 0; k < width; ++k)
      sum[place * width + k] += values[k] - centers_[place][k];
  }
  for (std::size_t c = 0; c < centers_.size(); ++c) Normalize({&sum[c * width], width});
  Normalize(sum);
  return sum;
}

double Cosine(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  }
  return sum;
}

}  // namespace lift_slam
