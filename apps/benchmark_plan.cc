#include "apps/benchmark_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/benchmark_data.h"
#include "apps/benchmark_matching_plan.h"
#include "apps/benchmark_variants.h"
#include "apps/build_info.h"
#include "apps/program_options.h"
#include "apps/vocabulary_choice.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/image/image_distortion.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_writer.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The paper's conditions (Table 4), and what it could not run.
const std::vector<std::string> kRobustnessConditions = {
    "none", "gamma=0.25",       "gamma=0.5",        "gamma=2",  "gamma=4", "q1",
    "q3",   "salt-pepper=0.02", "salt-pepper=0.05", "noise=10", "blur=1.5"};

std::vector<std::string> Systems(const BenchmarkRequest& request) {
  if (!request.systems.empty()) return request.systems;
  if (request.suite == "robustness") return {"orb_slam", "adaptive_tuned_euroc", "adaptive"};
  if (request.suite == "thresholds") {
    return {"lift_slam_100_200", "lift_slam_100_150", "lift_slam_200_300", "adaptive"};
  }
  return {"orb_slam",
          "lift_slam",
          "lift_slam_tuned_kitti",
          "lift_slam_tuned_euroc",
          "adaptive_tuned_kitti",
          "adaptive_tuned_euroc",
          "adaptive",
          "default_orb"};
}

std::vector<std::string> Conditions(const BenchmarkRequest& request) {
  std::vector<std::string> conditions = request.conditions;
  if (conditions.empty() && request.suite == "robustness") return kRobustnessConditions;
  if (conditions.empty()) return {"none"};
  for (std::string& condition : conditions) {
    if (condition != "none") condition = ToText(ParseImageDistortions(condition));
  }
  return WithoutRepeats(conditions);  // gamma=2 and gamma=2.0 are one
}

bool Contains(const std::vector<std::string>& values, const std::string& value) {
  return std::ranges::find(values, value) != values.end();
}

// Weights named in a preset are relative to where the program is run or to the presets' project.
fs::path FindWeights(const fs::path& named, const fs::path& config) {
  if (named.empty()) return {};
  for (const fs::path& path : {named, config.parent_path() / "../.." / named}) {
    if (fs::is_regular_file(path)) return fs::canonical(path);
  }
  return {};
}

// Whether a word of a system's "# skip:" means the sequence: MH_04 is MH_04_difficult too. A name
// for the tables may differ from the folder's (kitti/sequences/00 is "kitti" beside others of that
// number), and rendered tracks are no sequence of KITTI, though they lie in such folders.
bool IsTrainedWith(const BenchmarkSystem& system, const BenchmarkSequence& sequence) {
  const bool is_rendered = fs::exists(sequence.folder.parent_path().parent_path() / "render.yaml");
  const std::string folder = is_rendered ? "" : sequence.folder.filename().string();
  return std::ranges::any_of(system.skipped_sequences, [&](const std::string& word) {
    const auto is_meant = [&](const std::string& name) {
      return name == word || name.starts_with(word + "_");
    };
    return is_meant(sequence.name) || is_meant(folder);
  });
}

std::string WhereFrom(const std::string& dataset) {
  return dataset == "kitti" ? "KITTI odometry, grayscale images and ground truth poses"
                            : "EuRoC MAV, ASL dataset format";
}

// The published sequence is one of them, and nothing tells which.
void CheckIsTheOnlyOne(const BenchmarkSequence& sequence) {
  if (sequence.rival.empty()) return;
  throw InputError(fmt::format("--data: both {} and {} may be sequence {}: give a narrower folder",
                               sequence.folder.string(), sequence.rival.string(), sequence.name));
}

class PlanMaker {
 public:
  explicit PlanMaker(const BenchmarkRequest& request) : request_(request) {
    plan_.suite = request.suite;
    plan_.revision = kGitRevision;
    plan_.frames = request.frames;
    plan_.conditions = Conditions(request);
    if (request.suite == "ablation") variants_ = ReadBenchmarkVariants(request.variants);
  }

  BenchmarkPlan Make() {
    for (const BenchmarkSequence& sequence : ChosenSequences(request_)) {
      plan_.sequences.push_back(sequence.name);
      if (sequence.folder.empty()) {
        plan_.missing.push_back(fmt::format("sequence {} is not below {} ({})", sequence.name,
                                            request_.data.string(), WhereFrom(sequence.dataset)));
      }
      for (const std::string& name : SystemNames()) AddSystem(name, sequence);
    }
    // Round after round, so that a benchmark cut short has something of everything.
    std::ranges::stable_sort(plan_.jobs, {}, &BenchmarkJob::seed);
    return plan_;
  }

 private:
  std::vector<std::string> SystemNames() const {
    if (!variants_ || !request_.systems.empty()) return WithoutRepeats(Systems(request_));
    std::vector<std::string> names;
    for (const BenchmarkVariant& variant : variants_->variants) names.push_back(variant.name);
    return names;
  }

  // A preset, or a variant of the ablation.
  BenchmarkSystem FindSystem(const std::string& name, const std::string& dataset) const {
    if (!variants_) return FindBenchmarkSystem(name, dataset);
    const BenchmarkVariant& variant = FindVariant(*variants_, name);
    BenchmarkSystem system = FindBenchmarkSystem(variants_->base, dataset);
    system.name = variant.name;
    system.title = variant.title;
    system.settings = variant.settings;
    return system;
  }

  // What the variant says counts more than what is asked for all.
  std::vector<std::string> Settings(const BenchmarkSystem& system) const {
    std::vector<std::string> settings = request_.overrides;
    settings.insert(settings.end(), system.settings.begin(), system.settings.end());
    return settings;
  }

  void AddSystem(const std::string& name, const BenchmarkSequence& sequence) {
    const BenchmarkSystem system = FindSystem(name, sequence.dataset);
    AddTitle(system);
    if (sequence.folder.empty()) return;
    if (IsTrainedWith(system, sequence)) {
      plan_.skipped.push_back(system.title + "|" + sequence.name);
      return;
    }
    ProgramOptions options;
    ConfigureOptions(system.config, Settings(system), MakeOptionRoot(options));
    const fs::path named = options.slam.features.lift_weights;
    const fs::path weights = FindWeights(named, system.config);
    if (!named.empty() && weights.empty()) {
      const std::string sentence =
          fmt::format("{}: the weights {} are not there ({})", system.title, named.string(),
                      system.making.empty() ? "docs/training.md says how to make them"
                                            : "made by " + system.making);
      if (!Contains(plan_.missing, sentence)) plan_.missing.push_back(sentence);
      return;
    }
    AddJobs(system, sequence, options, weights);
  }

  // Tables tell systems apart by their titles.
  void AddTitle(const BenchmarkSystem& system) {
    const auto [entry, is_new] = name_of_title_.emplace(system.title, system.name);
    if (is_new) plan_.titles.push_back(system.title);
    if (entry->second == system.name) return;
    throw InputError(
        fmt::format("{}: the systems {} and {} both have the title '{}', so no table could tell "
                    "them apart: change one's '# title:' line or leave it out",
                    system.config.string(), entry->second, system.name, system.title));
  }

  void AddJobs(const BenchmarkSystem& system, const BenchmarkSequence& sequence,
               ProgramOptions& options, const fs::path& weights) {
    const bool is_lift = options.slam.features.type == FeatureType::kLift;
    const std::string lift_hash = is_lift ? WeightsHash(weights, system.title) : "";
    const std::string vocabulary_hash = VocabularyHash(options.slam.loop_closing);
    plan_.hashes["sequence " + sequence.name] = IdentityOf(sequence.folder);
    for (const std::string& condition : plan_.conditions) {
      for (int seed = 0; seed < request_.runs; ++seed) {
        BenchmarkJob job{system.name,
                         system.title,
                         sequence.name,
                         condition == "none" ? "" : condition,
                         seed,
                         sequence.folder,
                         system.config,
                         weights,
                         Settings(system),
                         request_.frames,
                         0,
                         ""};
        const std::string identity = fmt::format(
            "{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", OptionsToYaml(MakeOptionRoot(options)),
            lift_hash, vocabulary_hash, program_, job.sequence, IdentityOf(job.source),
            job.distortion, job.frames, seed,
            job.system);  // two systems alike still have a folder each
        job.hash = Sha256Hex(identity).substr(0, 16);
        plan_.jobs.push_back(job);
      }
    }
  }

  const std::string& IdentityOf(const fs::path& sequence) {
    std::string& identity = sequence_identities_[sequence];
    if (identity.empty()) identity = SequenceIdentity(sequence);
    return identity;
  }

  const std::string& WeightsHash(const fs::path& weights, const std::string& title) {
    const fs::path file = weights.empty() ? DefaultLiftWeights() : weights;
    const std::string& hash = HashOf(file);
    plan_.hashes[WeightsKey(file, title)] = hash;
    return hash;
  }

  // Of all that a run may choose from; empty without loop closing.
  std::string VocabularyHash(const LoopClosingOptions& options) {
    std::string hashes;
    for (const fs::path& file : VocabularyFiles(options)) hashes += HashOf(file);
    return hashes;
  }

  const std::string& HashOf(const fs::path& file) {
    std::string& hash = file_hashes_[file];
    if (hash.empty()) hash = Sha256Hex(ReadText(file));
    return hash;
  }

  const BenchmarkRequest& request_;
  std::optional<BenchmarkVariants> variants_;  // of the ablation
  std::map<std::string, std::string> name_of_title_;
  BenchmarkPlan plan_;
  const std::string program_ = ProgramIdentity();
  std::map<fs::path, std::string> file_hashes_, sequence_identities_;
};

Json ToJson(const BenchmarkJob& job) {
  return {{"system", job.system},
          {"title", job.title},
          {"sequence", job.sequence},
          {"distortion", job.distortion},
          {"seed", job.seed},
          {"source", job.source.string()},
          {"config", job.config.string()},
          {"weights", job.weights.string()},
          {"overrides", job.overrides},
          {"frames", job.frames},
          {"pairs", job.pairs},
          {"hash", job.hash}};
}

BenchmarkJob JobFromJson(const Json& json) {
  BenchmarkJob job;
  job.system = json.at("system").get<std::string>();
  job.title = json.at("title").get<std::string>();
  job.sequence = json.at("sequence").get<std::string>();
  job.distortion = json.at("distortion").get<std::string>();
  job.seed = json.at("seed").get<int>();
  job.source = json.at("source").get<std::string>();
  job.config = json.at("config").get<std::string>();
  job.weights = json.at("weights").get<std::string>();
  job.overrides = json.at("overrides").get<std::vector<std::string>>();
  job.frames = json.at("frames").get<std::string>();
  job.pairs = json.value("pairs", 0);
  job.hash = json.at("hash").get<std::string>();
  return job;
}

}  // namespace

std::vector<std::string> WithoutRepeats(const std::vector<std::string>& values) {
  std::vector<std::string> different;
  for (const std::string& value : values) {
    if (!Contains(different, value)) different.push_back(value);
  }
  return different;
}

std::string WeightsKey(const fs::path& file, const std::string& title) {
  return fmt::format("weights {} of {}", file.filename().string(), title);
}

std::vector<BenchmarkSequence> ChosenSequences(const BenchmarkRequest& request) {
  auto sequences = FindBenchmarkSequences(request.suite, request.data);
  std::vector<BenchmarkSequence> others;
  for (const std::string& wanted : request.sequences) {
    const auto is_wanted = [&](const BenchmarkSequence& sequence) {
      return sequence.name == wanted;
    };
    if (std::ranges::any_of(sequences, is_wanted)) continue;
    if (others.empty()) others = FindBenchmarkSequences("shared", request.data);
    const auto other = std::ranges::find_if(others, is_wanted);
    if (other == others.end()) {
      throw InputError(fmt::format("--sequences: '{}' is neither in the suite '{}' nor below '{}'",
                                   wanted, request.suite, request.data.string()));
    }
    sequences.push_back(*other);
  }
  std::erase_if(sequences, [&](const BenchmarkSequence& sequence) {
    return !request.sequences.empty() && !Contains(request.sequences, sequence.name);
  });
  for (const BenchmarkSequence& sequence : sequences) CheckIsTheOnlyOne(sequence);
  return sequences;
}

BenchmarkPlan MakeBenchmarkPlan(const BenchmarkRequest& request) {
  if (std::ranges::find(kBenchmarkSuites, request.suite) == std::end(kBenchmarkSuites)) {
    throw InputError(fmt::format("suite '{}' is unknown; expected one of {}", request.suite,
                                 fmt::join(kBenchmarkSuites, ", ")));
  }
  if (request.suite == "matching") return MakeMatchingPlan(request);
  if (request.runs < 1) throw InputError("--runs must be at least 1");
  BenchmarkPlan plan = PlanMaker(request).Make();
  if (!plan.jobs.empty()) return plan;
  throw InputError(
      fmt::format("nothing to run: {}",
                  plan.missing.empty()
                      ? "no sequence below " + request.data.string() +
                            (request.suite == "rendered" ? " (lift_slam render makes some)" : "")
                      : fmt::format("{}", fmt::join(plan.missing, "; "))));
}

void WriteBenchmarkPlan(const BenchmarkPlan& plan, const fs::path& folder) {
  Json json = {{"suite", plan.suite},         {"revision", plan.revision},
               {"frames", plan.frames},       {"titles", plan.titles},
               {"sequences", plan.sequences}, {"conditions", plan.conditions},
               {"skipped", plan.skipped},     {"missing", plan.missing},
               {"hashes", plan.hashes},       {"jobs", Json::array()}};
  for (const BenchmarkJob& job : plan.jobs) json["jobs"].push_back(ToJson(job));
  WriteTextAtomically(folder / "plan.json", json.dump(1) + "\n");
}

BenchmarkPlan ReadBenchmarkPlan(const fs::path& folder) {
  const fs::path path = folder / "plan.json";
  const std::string text = ReadText(path);
  try {
    const Json json = Json::parse(text);
    BenchmarkPlan plan;
    plan.suite = json.at("suite").get<std::string>();
    plan.revision = json.at("revision").get<std::string>();
    plan.frames = json.value("frames", "");
    plan.titles = json.at("titles").get<std::vector<std::string>>();
    plan.sequences = json.at("sequences").get<std::vector<std::string>>();
    plan.conditions = json.at("conditions").get<std::vector<std::string>>();
    plan.skipped = json.at("skipped").get<std::vector<std::string>>();
    plan.missing = json.at("missing").get<std::vector<std::string>>();
    plan.hashes = json.value("hashes", plan.hashes);
    for (const Json& job : json.at("jobs")) plan.jobs.push_back(JobFromJson(job));
    return plan;
  } catch (const Json::exception&) {
    throw InputError(fmt::format("{}: is no plan of a benchmark; make it again", path.string()));
  }
}

}  // namespace lift_slam
