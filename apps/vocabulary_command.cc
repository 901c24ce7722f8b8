#include "apps/vocabulary_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "apps/vocabulary_build.h"
#include "apps/vocabulary_query.h"
#include "lift_slam/place_recognition/vocabulary.h"

namespace lift_slam {
namespace {

constexpr int kMaxSidePx = 100000;

void AddImageOptions(CLI::App& command, int& step, int& max_side_px) {
  command.add_option("--step", step, "Every so many images of a folder")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--max-side", max_side_px, "Larger images are shrunk to it, pixels; 0: never")
      ->check(CLI::Range(0, kMaxSidePx))
      ->capture_default_str();
}

void AddBuild(CLI::App& vocabulary) {
  CLI::App* command = vocabulary.add_subcommand("build", "Train a vocabulary from images");
  auto arguments = std::make_shared<VocabularyBuildArguments>();
  VocabularyTrainingOptions& training = arguments->training;
  command->add_option("IMAGES", arguments->sources, "Images, or folders with all below them")
      ->required();
  command->add_option("--output", arguments->output, "File to write")->required();
  command->add_option("--descriptors", arguments->descriptors,
                      "File of descriptors to keep and to go on with (default: beside the output, "
                      "removed at the end)");
  AddImageOptions(*command, arguments->step, arguments->max_side_px);
  arguments->features.AddTo(*command);
  command->add_option("--branching", training.branching, "Children of a node, k")
      ->capture_default_str();
  command->add_option("--depth", training.depth, "Levels, L; the paper has 10^6 words with 6")
      ->capture_default_str();
  command
      ->add_option("--min-rows", training.min_rows_to_split,
                   "A node of fewer descriptors stays a word")
      ->capture_default_str();
  command->add_option("--iterations", training.max_iterations, "Of k-means")->capture_default_str();
  command->add_option("--seed", training.seed, "Of the first centers")->capture_default_str();
  command->callback([arguments] {
    arguments->training.num_threads = arguments->features.num_threads;
    BuildVocabulary(*arguments);
  });
  command->footer(
      "Examples:\n"
      "  lift_slam vocabulary build photographs/ drives/ --step 5 --output orb.vocabulary\n"
      "  lift_slam vocabulary build tum_mono/ --weights lift.safetensors --depth 6 --min-rows 2 "
      "--output paper.vocabulary\n"
      "Stopped by a signal, the same command goes on.");
}

void PrintInfo(const std::filesystem::path& file) {
  const Vocabulary vocabulary(file);
  const VocabularyInfo& info = vocabulary.info();
  const auto print = [](const char* name, const std::string& value) {
    std::cout << fmt::format("{:<14}{}\n", name, value);
  };
  const bool is_binary = info.kind.metric == DescriptorMetric::kHamming;
  print("descriptors", fmt::format("{} ({} {})", info.kind.name, info.kind.dimension,
                                   is_binary ? "bits, Hamming distance" : "floats, L2 distance"));
  print("tree", fmt::format("k = {}, L = {}, {} nodes, {} words", info.branching, info.depth,
                            info.num_nodes, info.num_words));
  print("direct index", fmt::format("level {}, {} nodes", vocabulary.direct_level(),
                                    vocabulary.direct_nodes().size()));
  print("trained from", fmt::format("{} descriptors of {} images", info.num_rows, info.num_images));
  print("sources", info.description);
  print("size", fmt::format("{:.2f} MB", static_cast<double>(info.num_bytes) * 1e-6));
  print("checksum", fmt::format("{:016x}", info.checksum));
}

void AddInfo(CLI::App& vocabulary) {
  CLI::App* command = vocabulary.add_subcommand("info", "Print what a vocabulary holds");
  auto file = std::make_shared<std::filesystem::path>();
  command->add_option("FILE", *file, "Vocabulary")->required();
  command->callback([file] { PrintInfo(*file); });
}

void AddQuery(CLI::App& vocabulary) {
  CLI::App* command =
      vocabulary.add_subcommand("query", "Look images up among others, with scores");
  auto arguments = std::make_shared<VocabularyQueryArguments>();
  command->add_option("FILE", arguments->vocabulary, "Vocabulary")->required();
  command->add_option("--query", arguments->queries, "Images or folders to look up")->required();
  command->add_option("--among", arguments->database,
                      "Images or folders to look in (default: the other queries)");
  command->add_option("--score", arguments->score, "How bags of words are compared")
      ->check(CLI::IsMember({"l1", "l2"}))
      ->capture_default_str();
  command->add_option("--best", arguments->best, "Matches shown for each")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  AddImageOptions(*command, arguments->step, arguments->max_side_px);
  arguments->features.AddTo(*command);
  command->callback([arguments] { QueryVocabulary(*arguments); });
}

}  // namespace

void AddVocabularyCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("vocabulary", "Build, describe and try visual vocabularies");
  command->require_subcommand(1);
  AddBuild(*command);
  AddInfo(*command);
  AddQuery(*command);
}

}  // namespace lift_slam
