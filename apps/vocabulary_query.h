#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/feature_arguments.h"

namespace lift_slam {

struct VocabularyQueryArguments {
  std::filesystem::path vocabulary;
  std::vector<std::filesystem::path> queries;
  std::vector<std::filesystem::path> database;  // empty: the queries, each but itself
  std::string score = "l2";
  int best = 3;  // matches shown for each
  int step = 1;
  int max_side_px = 1280;
  FeatureArguments features;
};

// `lift_slam vocabulary query`: prints for each image the most alike with scores.
void QueryVocabulary(const VocabularyQueryArguments& arguments);

}  // namespace lift_slam
