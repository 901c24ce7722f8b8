#include "apps/vocabulary_query.h"

#include <fmt/format.h>

#include <iostream>

#include "apps/vocabulary_images.h"
#include "lift_slam/image/image_threads.h"
#include "lift_slam/place_recognition/keyframe_database.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

BagScore ParseScore(const std::string& name) {
  return name == kBagScoreNames[0] ? BagScore::kL1 : BagScore::kL2;
}

std::vector<BagOfWords> BagsOf(const std::vector<fs::path>& images,
                               const VocabularyQueryArguments& arguments,
                               const Vocabulary& vocabulary, FeatureExtractor& extractor) {
  std::vector<BagOfWords> bags;
  for (const fs::path& image : images) {
    std::string why;
    const auto pixels = ReadImageOfSide(image, arguments.max_side_px, &why);
    if (!pixels)
      throw InputError(fmt::format("image '{}' cannot be read: {}", image.string(), why));
    bags.push_back(vocabulary.Transform(extractor.Extract(*pixels).descriptors).bag);
  }
  return bags;
}

void PrintMatches(const fs::path& query, const std::vector<PlaceCandidate>& candidates,
                  const std::vector<fs::path>& images, int best) {
  std::cout << query.string() << '\n';
  if (candidates.empty()) std::cout << "  nothing in common with any image\n";
  for (std::size_t i = 0; i < candidates.size() && i < static_cast<std::size_t>(best); ++i) {
    std::cout << fmt::format("  {:.4f}  {:5} words  {}\n", candidates[i].score,
                             candidates[i].common_words,
                             images[static_cast<std::size_t>(candidates[i].keyframe)].string());
  }
}

}  // namespace

void QueryVocabulary(const VocabularyQueryArguments& arguments) {
  DisableImageThreads();
  const Vocabulary vocabulary(arguments.vocabulary);
  const auto extractor = arguments.features.MakeExtractor();
  vocabulary.CheckKind(extractor->descriptor_kind());
  const std::vector<fs::path> queries = CollectImages(arguments.queries, arguments.step);
  const bool is_among_itself = arguments.database.empty();
  const std::vector<fs::path> images =
      is_among_itself ? queries : CollectImages(arguments.database, arguments.step);
  const auto bags = BagsOf(images, arguments, vocabulary, *extractor);
  KeyframeDatabase database(ParseScore(arguments.score));
  for (std::size_t i = 0; i < bags.size(); ++i) database.Add(static_cast<int>(i), bags[i]);
  const auto query_bags =
      is_among_itself ? bags : BagsOf(queries, arguments, vocabulary, *extractor);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    std::vector<int> itself;
    if (is_among_itself) itself.push_back(static_cast<int>(i));
    PrintMatches(queries[i], database.Query(query_bags[i], itself), images, arguments.best);
  }
}

}  // namespace lift_slam
