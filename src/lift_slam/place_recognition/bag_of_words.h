#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lift_slam {

// A visual word of an image. A word's id is the index of its leaf in the vocabulary's tree.
struct WordWeight {
  std::uint32_t word = 0;
  float weight = 0.0F;  // tf-idf; the weights of an image add up to 1
  friend bool operator==(const WordWeight&, const WordWeight&) = default;
};

// What an image looks like: its words, ascending, each once.
struct BagOfWords {
  std::vector<WordWeight> words;
  float norm = 0.0F;  // of the weights (L2); 0 when there are no words

  // Sorts, adds up weights of one word, leaves out weights of 0, scales the sum to 1.
  static BagOfWords FromWeights(std::vector<WordWeight> weights);
};

enum class BagScore {
  kL1,  // 1 - |v - w|_1 / 2, of vectors of L1 norm 1 (DBoW; ORB-SLAM)
  kL2,  // 1 - |v - w|_2 / sqrt(2) = 1 - sqrt(1 - v.w), of vectors of L2 norm 1 (the paper's, by
        // Nister and Stewenius, scaled to [0, 1] as DBoW2 does)
};
inline constexpr std::string_view kBagScoreNames[] = {"l1", "l2"};

// How alike two images are, in [0, 1]; 0 when they share no word. Both orders give the same bits.
double Score(const BagOfWords& a, const BagOfWords& b, BagScore score);

// A score as a sum over the words in both images: ScoreFromSum(sum of SharedWordTerm).
double SharedWordTerm(float a, float b, BagScore score);
double ScoreFromSum(double sum, const BagOfWords& a, const BagOfWords& b, BagScore score);

// Features of an image by node of the vocabulary at the direct index's level: only features of one
// node need be compared. Group g has node nodes[g] (ascending) and the features
// features[begin[g]] to features[begin[g + 1] - 1] (ascending).
struct DirectIndex {
  std::vector<std::uint32_t> nodes, begin, features;

  std::size_t size() const { return nodes.size(); }
  std::span<const std::uint32_t> group(std::size_t g) const {
    return {features.data() + begin[g], features.data() + begin[g + 1]};
  }
  // node_of_feature[i] is the node of feature i.
  static DirectIndex FromNodes(const std::vector<std::uint32_t>& node_of_feature);
};

// Calls visit(features of a, features of b) for each node in both, in order of node.
template <class Visit>
void ForEachSharedNode(const DirectIndex& a, const DirectIndex& b, Visit&& visit) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a.nodes[i] < b.nodes[j]) {
      ++i;
    } else if (b.nodes[j] < a.nodes[i]) {
      ++j;
    } else {
      visit(a.group(i++), b.group(j++));
    }
  }
}

}  // namespace lift_slam
