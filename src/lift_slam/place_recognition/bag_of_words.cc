#include "lift_slam/place_recognition/bag_of_words.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lift_slam {

BagOfWords BagOfWords::FromWeights(std::vector<WordWeight> weights) {
  std::stable_sort(weights.begin(), weights.end(),
                   [](const WordWeight& a, const WordWeight& b) { return a.word < b.word; });
  BagOfWords bag;
  double sum = 0.0;
  for (const WordWeight& entry : weights) {
    if (!(entry.weight > 0.0F)) continue;
    sum += static_cast<double>(entry.weight);
    if (!bag.words.empty() && bag.words.back().word == entry.word) {
      bag.words.back().weight += entry.weight;
    } else {
      bag.words.push_back(entry);
    }
  }
  double squares = 0.0;
  for (WordWeight& entry : bag.words) {
    entry.weight = static_cast<float>(static_cast<double>(entry.weight) / sum);
    squares += static_cast<double>(entry.weight) * static_cast<double>(entry.weight);
  }
  bag.norm = static_cast<float>(std::sqrt(squares));
  return bag;
}

// |v| + |w| - |v - w| = 2 min(v, w): words in one image only add nothing.
double SharedWordTerm(float a, float b, BagScore score) {
  if (score == BagScore::kL1) return static_cast<double>(std::min(a, b));
  return static_cast<double>(a) * static_cast<double>(b);
}

double ScoreFromSum(double sum, const BagOfWords& a, const BagOfWords& b, BagScore score) {
  if (score == BagScore::kL1) return std::clamp(sum, 0.0, 1.0);
  if (!(sum > 0.0)) return 0.0;
  const double cosine = sum / (static_cast<double>(a.norm) * static_cast<double>(b.norm));
  return 1.0 - std::sqrt(std::max(0.0, 1.0 - cosine));
}

double Score(const BagOfWords& a, const BagOfWords& b, BagScore score) {
  double sum = 0.0;
  for (auto i = a.words.begin(), j = b.words.begin(); i != a.words.end() && j != b.words.end();) {
    if (i->word < j->word) {
      ++i;
    } else if (j->word < i->word) {
      ++j;
    } else {
      sum += SharedWordTerm((i++)->weight, (j++)->weight, score);
    }
  }
  return ScoreFromSum(sum, a, b, score);
}

DirectIndex DirectIndex::FromNodes(const std::vector<std::uint32_t>& node_of_feature) {
  DirectIndex index;
  index.features.resize(node_of_feature.size());
  std::iota(index.features.begin(), index.features.end(), 0U);
  std::stable_sort(
      index.features.begin(), index.features.end(),
      [&](std::uint32_t a, std::uint32_t b) { return node_of_feature[a] < node_of_feature[b]; });
  for (std::uint32_t i = 0; i < index.features.size(); ++i) {
    const std::uint32_t node = node_of_feature[index.features[i]];
    if (!index.nodes.empty() && index.nodes.back() == node) continue;
    index.nodes.push_back(node);
    index.begin.push_back(i);
  }
  index.begin.push_back(static_cast<std::uint32_t>(index.features.size()));
  return index;
}

}  // namespace lift_slam
