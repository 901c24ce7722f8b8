#pragma once

#include <string>
#include <vector>

#include "apps/pair_features.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/features/image_pair.h"

namespace lift_slam {

inline constexpr int kMaxPairSkip = 10;
// The paper's frame skip (sec. 3.1); the second images of the gamma conditions are as far away.
inline constexpr int kGammaSkip = 5;
inline constexpr double kPairGammas[] = {0.25, 0.5, 2.0, 4.0};

// "t+1" to "t+10", then "gamma=0.25" and so on.
std::vector<std::string> PairConditions();

// How one pair of images was matched.
struct PairCount {
  std::int64_t frame_index = 0;  // of the first image
  int features_a = 0, features_b = 0, matches = 0, inliers = 0;
};

struct PairCounts {
  std::string features;                       // title of the extractor
  std::string model;                          // "essential" with a calibration, else "fundamental"
  std::vector<std::vector<PairCount>> pairs;  // by PairConditions(), then by frame
};

// `num_pairs` first images evenly spread over the sequence, each matched with the frames 1 to 10
// after it, and with that 5 after it under each gamma. Unreadable images leave their pairs out.
// Throws InputError for what cannot be opened, and for a sequence of less than 11 frames.
PairCounts CountPairs(const std::string& source, const SequenceOptions& options,
                      const PairFeatures& features, int num_pairs);

}  // namespace lift_slam
