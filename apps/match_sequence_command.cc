#include "apps/match_sequence_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/build_info.h"
#include "apps/program_options.h"
#include "apps/sequence_arguments.h"
#include "apps/sequence_pairs.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/provenance.h"

namespace lift_slam {
namespace {

using Json = nlohmann::ordered_json;

struct MatchSequenceArguments {
  SequenceArguments sequence;
  PairFeatures features;
  std::filesystem::path output;
  int num_pairs = 20;
};

Json ConditionsJson(const PairCounts& counts) {
  const std::vector<std::string> conditions = PairConditions();
  Json json = Json::object();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    Json& pairs = json[conditions[i]] = Json::array();
    for (const PairCount& pair : counts.pairs[i]) {
      pairs.push_back({{"frame", pair.frame_index},
                       {"features_a", pair.features_a},
                       {"features_b", pair.features_b},
                       {"matches", pair.matches},
                       {"inliers", pair.inliers}});
    }
  }
  return json;
}

Json ProvenanceJson() {
  ProgramOptions options;
  const Provenance p = CollectProvenance(kProgramVersion, kGitRevision, MakeOptionRoot(options));
  return {{"program_version", p.program_version},
          {"git_revision", p.git_revision},
          {"cpu_name", p.cpu_name},
          {"threads", p.threads},
          {"date_utc", p.date_utc}};
}

void MatchSequence(const MatchSequenceArguments& arguments) {
  if (arguments.num_pairs < 1) throw InputError("--pairs must be at least 1");
  SequenceOptions options = arguments.sequence.Options();
  options.calibration = CalibrationNeed::kOptional;
  const PairCounts counts =
      CountPairs(arguments.sequence.source, options, arguments.features, arguments.num_pairs);
  const Json json = {{"features", counts.features},
                     {"model", counts.model},
                     {"conditions", ConditionsJson(counts)},
                     {"interrupted", false},
                     {"provenance", ProvenanceJson()}};
  CreateFolder(arguments.output);
  WriteTextAtomically(arguments.output / "result.json", json.dump(1) + "\n");
  std::cout << fmt::format("{}: {} pairs a condition, {}\n", counts.features,
                           counts.pairs.front().size(),
                           (arguments.output / "result.json").string());
}

}  // namespace

void AddMatchSequenceCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "match-sequence", "Inliers over pairs of images 1 to 10 frames apart, and under gamma");
  const auto arguments = std::make_shared<MatchSequenceArguments>();
  arguments->sequence.AddTo(*command);
  PairFeatures& features = arguments->features;
  features.lift.num_threads = 2;
  command->add_option("--output", arguments->output, "Folder for result.json")->required();
  command->add_option("--features", features.name, "lift, orb or sift")->capture_default_str();
  command->add_option("--weights", features.weights,
                      "LIFT weights (.safetensors; default: those that ship)");
  command->add_option("--pairs", arguments->num_pairs, "First images, spread over the sequence")
      ->capture_default_str();
  command->add_option("--max-features", features.lift.max_features, "Features an image")
      ->capture_default_str();
  command->callback([arguments] { MatchSequence(*arguments); });
}

}  // namespace lift_slam
