#include "apps/sequence_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lift_slam/image/gamma.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::size_t kNumConditions = kMaxPairSkip + std::size(kPairGammas);

// Positions of the first images among `num_frames`, the first and the last that has all its
// partners included.
std::set<std::int64_t> Starts(std::int64_t num_frames, int num_pairs) {
  const std::int64_t last = num_frames - 1 - kMaxPairSkip;
  std::set<std::int64_t> starts;
  for (int i = 0; i < num_pairs; ++i) {
    starts.insert(num_pairs == 1 ? 0 : last * i / (num_pairs - 1));
  }
  return starts;
}

class PairCounter {
 public:
  PairCounter(FeatureExtractor& extractor, const SequenceInfo& info)
      : extractor_(extractor), camera_(info.camera ? &*info.camera : nullptr) {}

  // The first frame of `sequence` with those after it.
  void Count(Sequence& sequence, std::vector<std::vector<PairCount>>& pairs) {
    const auto first = sequence.Next();
    if (!first || !first->image) return;
    const FeatureSet a = extractor_.Extract(*first->image);
    const auto count = [&](const GrayImage& image, std::size_t condition) {
      pairs[condition].push_back(CountPair(a, extractor_.Extract(image), first->frame_index));
    };
    for (std::size_t skip = 1; skip <= kMaxPairSkip; ++skip) {
      const auto frame = sequence.Next();
      if (!frame) return;
      if (!frame->image) continue;
      count(*frame->image, skip - 1);
      if (skip != kGammaSkip) continue;
      for (std::size_t i = 0; i < std::size(kPairGammas); ++i) {
        count(ApplyGamma(*frame->image, kPairGammas[i]), kMaxPairSkip + i);
      }
    }
  }

 private:
  PairCount CountPair(const FeatureSet& a, const FeatureSet& b, std::int64_t frame_index) const {
    const ImagePairResult result = MatchImagePair(a, b, camera_, ImagePairOptions());
    return {frame_index, static_cast<int>(a.keypoints.size()), static_cast<int>(b.keypoints.size()),
            static_cast<int>(result.matches.size()), result.num_inliers};
  }

  FeatureExtractor& extractor_;
  const Camera* camera_;
};

}  // namespace

std::vector<std::string> PairConditions() {
  std::vector<std::string> conditions;
  for (int skip = 1; skip <= kMaxPairSkip; ++skip) conditions.push_back(fmt::format("t+{}", skip));
  for (const double gamma : kPairGammas) conditions.push_back(fmt::format("gamma={:g}", gamma));
  return conditions;
}

PairCounts CountPairs(const std::string& source, const SequenceOptions& options,
                      const PairFeatures& features, int num_pairs) {
  const auto whole = OpenSequence(source, options);
  const auto first = whole->Next();
  const std::int64_t num_frames = whole->info().num_frames.value_or(0);
  if (!first || num_frames <= kMaxPairSkip) {
    throw InputError(fmt::format("{}: has {} frames, pairs up to {} frames apart need {}", source,
                                 num_frames, kMaxPairSkip, kMaxPairSkip + 1));
  }
  const NamedExtractor named = MakeExtractor(features);
  PairCounter counter(*named.extractor, whole->info());
  PairCounts counts{named.title, whole->info().camera ? "essential" : "fundamental", {}};
  counts.pairs.resize(kNumConditions);
  for (const std::int64_t start : Starts(num_frames, num_pairs)) {
    SequenceOptions part = options;
    part.first = first->frame_index + start * options.step;
    part.last = part.first + kMaxPairSkip * options.step;
    counter.Count(*OpenSequence(source, part), counts.pairs);
  }
  return counts;
}

}  // namespace lift_slam
