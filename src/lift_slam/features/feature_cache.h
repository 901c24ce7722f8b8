#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "lift_slam/features/feature_extractor.h"

namespace lift_slam {

// Features kept in a folder, a file for each image: features take much of the time of a run
// (learned ones most of it), and runs with other seeds or other options after the features repeat
// them. Found again by the image's content and how its features are made, so a folder serves any
// number of sequences and settings; processes may share it. A file that is damaged or cannot be
// read counts as missing. Features made on another kind of processor may differ in their last bits.
class FeatureCache {
 public:
  struct Statistics {
    int num_found = 0, num_made = 0;
    std::string write_error;  // why features could not be kept, the first time; empty: they were
  };

  // Makes the folder. Throws InputError when it cannot be made.
  explicit FeatureCache(std::filesystem::path folder);

  // `identity`: all that decides what the features of an image are.
  static std::string KeyOf(const GrayImage& image, const std::string& identity);
  // Nothing when they are not there, or not of this kind.
  std::optional<FeatureSet> Find(const std::string& key, const DescriptorKind& kind);
  // A disk that is full ends the keeping, not the run.
  void Keep(const std::string& key, const FeatureSet& features);

  const Statistics& statistics() const { return statistics_; }

 private:
  std::filesystem::path PathOf(const std::string& key) const;

  std::filesystem::path folder_;
  Statistics statistics_;
};

// An extractor that looks into the cache first.
std::unique_ptr<FeatureExtractor> WithCache(std::unique_ptr<FeatureExtractor> extractor,
                                            std::string identity,
                                            std::shared_ptr<FeatureCache> cache);

}  // namespace lift_slam
