#include "lift_slam/features/feature_cache.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <span>
#include <utility>

#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/mapped_file.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

// To be raised when an extractor (features/orb, features/lift) gives other features for the same
// options: caches outlive revisions.
constexpr char kVersion[] = "1";

// A file: this, the keypoints, the rows of the descriptors.
struct Header {
  std::array<char, 8> magic = {'L', 'S', 'F', 'E', 'A', 'T', '0', '1'};
  std::uint64_t num_features = 0;
  std::uint64_t bytes_per_row = 0;
  std::uint64_t checksum = 0;  // of what follows
};

static_assert(sizeof(Keypoint) == 20, "keypoints are written as they lie in memory");

std::uint64_t ChecksumOf(std::span<const std::byte> keypoints, std::span<const std::byte> rows) {
  return Checksum64(rows, Checksum64(keypoints));
}

std::optional<FeatureSet> Parse(std::span<const std::byte> bytes, const DescriptorKind& kind) {
  Header header;
  const Header expected;
  if (bytes.size() < sizeof(header)) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof(header));
  bytes = bytes.subspan(sizeof(header));
  const std::size_t row_size = kind.BytesPerRow(), count = header.num_features;
  if (header.magic != expected.magic || header.bytes_per_row != row_size ||
      bytes.size() % (sizeof(Keypoint) + row_size) != 0 ||
      bytes.size() / (sizeof(Keypoint) + row_size) != count) {
    return std::nullopt;
  }
  const auto keypoints = bytes.first(count * sizeof(Keypoint));
  const auto rows = bytes.subspan(keypoints.size());
  if (ChecksumOf(keypoints, rows) != header.checksum) return std::nullopt;
  FeatureSet features{std::vector<Keypoint>(count), Descriptors(kind, count)};
  if (count > 0) {
    std::memcpy(features.keypoints.data(), keypoints.data(), keypoints.size());
    std::memcpy(features.descriptors.mutable_data(), rows.data(), rows.size());
  }
  return features;
}

void Write(std::ostream& out, std::span<const std::byte> bytes) {
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

class CachingExtractor : public FeatureExtractor {
 public:
  CachingExtractor(std::unique_ptr<FeatureExtractor> extractor, std::string identity,
                   std::shared_ptr<FeatureCache> cache)
      : extractor_(std::move(extractor)),
        identity_(std::move(identity)),
        cache_(std::move(cache)) {}

  FeatureSet Extract(const GrayImage& image) override {
    const std::string key = FeatureCache::KeyOf(image, identity_);
    if (auto found = cache_->Find(key, descriptor_kind())) return *std::move(found);
    FeatureSet features = extractor_->Extract(image);
    cache_->Keep(key, features);
    return features;
  }
  const ScaleLevels& scale_levels() const override { return extractor_->scale_levels(); }
  const DescriptorKind& descriptor_kind() const override { return extractor_->descriptor_kind(); }
  const ThresholdRange& thresholds() const override { return extractor_->thresholds(); }
  bool has_fine_positions() const override { return extractor_->has_fine_positions(); }
  std::string Notice() const override { return extractor_->Notice(); }

 private:
  std::unique_ptr<FeatureExtractor> extractor_;
  std::string identity_;
  std::shared_ptr<FeatureCache> cache_;
};

}  // namespace

FeatureCache::FeatureCache(std::filesystem::path folder) : folder_(std::move(folder)) {
  CreateFolder(folder_);
}

std::string FeatureCache::KeyOf(const GrayImage& image, const std::string& identity) {
  std::string bytes = std::string(kVersion) + '\n' + identity + '\n' +
                      std::to_string(image.width()) + ' ' + std::to_string(image.height()) + '\n';
  for (int y = 0; y < image.height(); ++y) {
    bytes.append(reinterpret_cast<const char*>(image.row(y)),
                 static_cast<std::size_t>(image.width()));
  }
  return Sha256Hex(bytes);
}

std::filesystem::path FeatureCache::PathOf(const std::string& key) const {
  return folder_ / key.substr(0, 2) / (key + ".features");
}

std::optional<FeatureSet> FeatureCache::Find(const std::string& key, const DescriptorKind& kind) {
  const std::filesystem::path path = PathOf(key);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  try {
    auto features = Parse(MappedFile(path).bytes(), kind);
    if (features) ++statistics_.num_found;
    return features;
  } catch (const InputError&) {  // not readable: a run does not end for a copy of what it can make
    return std::nullopt;
  }
}

void FeatureCache::Keep(const std::string& key, const FeatureSet& features) {
  ++statistics_.num_made;
  if (!statistics_.write_error.empty()) return;
  const auto keypoints = std::as_bytes(std::span(features.keypoints));
  const DescriptorKind& kind = features.descriptors.kind();
  const std::span rows(features.descriptors.data(),
                       features.descriptors.size() * kind.BytesPerRow());
  Header header;
  header.num_features = features.keypoints.size();
  header.bytes_per_row = kind.BytesPerRow();
  header.checksum = ChecksumOf(keypoints, rows);
  try {
    CreateFolder(PathOf(key).parent_path());
    WriteFileAtomically(PathOf(key), [&](std::ostream& out) {
      Write(out, std::as_bytes(std::span(&header, 1)));
      Write(out, keypoints);
      Write(out, rows);
    });
  } catch (const InputError& error) {
    statistics_.write_error = error.what();
  }
}

std::unique_ptr<FeatureExtractor> WithCache(std::unique_ptr<FeatureExtractor> extractor,
                                            std::string identity,
                                            std::shared_ptr<FeatureCache> cache) {
  return std::make_unique<CachingExtractor>(std::move(extractor), std::move(identity),
                                            std::move(cache));
}

}  // namespace lift_slam
