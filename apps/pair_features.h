#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/features/lift/lift_options.h"

namespace lift_slam {

// Which features a command on single images uses.
struct PairFeatures {
  std::string name = "lift";      // lift, orb or sift
  std::filesystem::path weights;  // of LIFT; empty: those that ship
  LiftExtractorOptions lift;      // max_features and num_threads hold for the others too
};

struct NamedExtractor {
  std::unique_ptr<FeatureExtractor> extractor;
  std::string title;  // "LIFT, bfloat16", for captions
};

// Throws InputError for an unknown name, and for other features with weights.
NamedExtractor MakeExtractor(const PairFeatures& features);

// Throws InputError naming the file when it cannot be read.
GrayImage ReadImageOrThrow(const std::filesystem::path& path);

// As extractor.Extract; what it says of a bad image is preceded by the file.
FeatureSet ExtractNamed(FeatureExtractor& extractor, const GrayImage& image,
                        const std::filesystem::path& path);

}  // namespace lift_slam
