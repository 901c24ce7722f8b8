#include "apps/vocabulary_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/util/environment.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/shipped_file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> VocabulariesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".vocabulary") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path VocabularyFolder() {
  const auto folder = EnvironmentPath("LIFT_SLAM_VOCABULARY_DIR");
  if (!folder) return ShippedFile("vocabularies");
  if (!fs::is_directory(*folder)) {
    throw InputError(
        fmt::format("LIFT_SLAM_VOCABULARY_DIR is '{}', which is not a folder", folder->string()));
  }
  return *folder;
}

}  // namespace

VocabularyChoice ChooseVocabulary(const LoopClosingOptions& options, const DescriptorKind& kind) {
  if (!options.enabled) return {nullptr, "switched off by slam.loop_closing.enabled"};
  if (!options.vocabulary.empty()) {
    auto named = std::make_shared<Vocabulary>(options.vocabulary);
    named->CheckKind(kind);
    return {std::move(named), {}};
  }
  const fs::path folder = VocabularyFolder();
  for (const fs::path& file : VocabulariesIn(folder)) {
    auto shipped = std::make_shared<Vocabulary>(file);
    if (shipped->info().kind == kind) return {std::move(shipped), {}};
  }
  return {nullptr, fmt::format("no vocabulary for '{}' features in '{}'; 'lift_slam vocabulary "
                               "build' makes one for --vocabulary",
                               kind.name, folder.string())};
}

std::vector<fs::path> VocabularyFiles(const LoopClosingOptions& options) {
  if (!options.enabled) return {};
  if (!options.vocabulary.empty()) return {options.vocabulary};
  return VocabulariesIn(VocabularyFolder());
}

}  // namespace lift_slam
