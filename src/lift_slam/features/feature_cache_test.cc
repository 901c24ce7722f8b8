#include "lift_slam/features/feature_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <thread>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

GrayImage MakeImage(std::uint8_t value) { return GrayImage(cv::Mat(5, 7, CV_8UC1, value)); }

// As many features as the image's first pixel says, and counts how often it is asked.
class CountingExtractor : public FeatureExtractor {
 public:
  explicit CountingExtractor(int* calls) : calls_(calls) {}
  FeatureSet Extract(const GrayImage& image) override {
    ++*calls_;
    FeatureSet features{{}, Descriptors(kind_, image.row(0)[0])};
    for (std::size_t i = 0; i < features.descriptors.size(); ++i) {
      features.keypoints.push_back({.x = static_cast<float>(i), .level = 3});
      for (std::byte& byte : features.descriptors.mutable_row(i)) byte = std::byte(i + 1);
    }
    return features;
  }
  const ScaleLevels& scale_levels() const override { return levels_; }
  const DescriptorKind& descriptor_kind() const override { return kind_; }
  const ThresholdRange& thresholds() const override { return thresholds_; }

 private:
  int* calls_;
  ScaleLevels levels_;
  DescriptorKind kind_{"test", DescriptorMetric::kHamming, 256};
  ThresholdRange thresholds_;
};

class FeatureCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("feature_cache_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    cache_ = std::make_shared<FeatureCache>(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  FeatureSet Extract(std::uint8_t pixel, const std::string& identity = "a") {
    return WithCache(std::make_unique<CountingExtractor>(&calls_), identity, cache_)
        ->Extract(MakeImage(pixel));
  }
  fs::path OnlyFile() const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) return entry.path();
    }
    return {};
  }

  fs::path folder_;
  std::shared_ptr<FeatureCache> cache_;
  int calls_ = 0;
};

TEST_F(FeatureCacheTest, GivesTheSameFeaturesWithoutMakingThemAgain) {
  const FeatureSet made = Extract(4), found = Extract(4);
  EXPECT_EQ(calls_, 1);
  ASSERT_EQ(found.keypoints.size(), 4U);
  EXPECT_EQ(found.keypoints[2].x, 2.0F);
  EXPECT_EQ(found.keypoints[2].level, 3);
  EXPECT_EQ(found.descriptors.kind(), made.descriptors.kind());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(std::ranges::equal(found.descriptors.row(i), made.descriptors.row(i)));
  }
  EXPECT_EQ(cache_->statistics().num_found, 1);
  EXPECT_EQ(cache_->statistics().num_made, 1);
}

TEST_F(FeatureCacheTest, KeepsAnImageWithoutFeatures) {
  Extract(0);
  EXPECT_TRUE(Extract(0).keypoints.empty());
  EXPECT_EQ(calls_, 1);
}

TEST_F(FeatureCacheTest, OtherPixelsOrOtherOptionsAreOtherFeatures) {
  Extract(4);
  EXPECT_EQ(Extract(5).keypoints.size(), 5U);
  Extract(4, "b");
  EXPECT_EQ(calls_, 3);
}

TEST_F(FeatureCacheTest, DamagedFilesAreMadeAnew) {
  Extract(4);
  const fs::path file = OnlyFile();
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_EQ(Extract(4).keypoints.size(), 4U);
  EXPECT_EQ(calls_, 2);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(60).put('!');
  EXPECT_EQ(Extract(4).keypoints[1].x, 1.0F);
  EXPECT_EQ(calls_, 3);
  Extract(4);
  EXPECT_EQ(calls_, 3);
}

TEST_F(FeatureCacheTest, WhatCannotBeReadIsMadeAnew) {
  Extract(4);
  const fs::path file = OnlyFile();
  fs::remove(file);
  fs::create_symlink("/proc/self/mem", file);  // a file that cannot be mapped
  EXPECT_EQ(Extract(4).keypoints.size(), 4U);
  EXPECT_EQ(calls_, 2);
}

TEST_F(FeatureCacheTest, FeaturesThatCannotBeKeptAreGivenAllTheSame) {
  fs::remove_all(folder_);
  std::ofstream(folder_) << "a file where the folder was";
  EXPECT_EQ(Extract(4).keypoints.size(), 4U);
  EXPECT_NE(cache_->statistics().write_error.find(folder_.string()), std::string::npos);
}

TEST_F(FeatureCacheTest, SeveralKeepTheSameFeaturesAtOnce) {
  std::vector<std::thread> threads;
  std::vector<FeatureCache> caches(4, FeatureCache(folder_));  // as of one process each
  const FeatureSet features = Extract(4);
  for (FeatureCache& cache : caches) {
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i) cache.Keep("0123", features);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const FeatureCache& cache : caches) EXPECT_EQ(cache.statistics().write_error, "");
  EXPECT_TRUE(caches[0].Find("0123", features.descriptors.kind()).has_value());
}

TEST_F(FeatureCacheTest, AFolderThatCannotBeMadeIsRefused) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(FeatureCache(folder_ / "file" / "below"), InputError);
}

}  // namespace
}  // namespace lift_slam
