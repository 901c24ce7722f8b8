#include "apps/benchmark_matching_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/benchmark_data.h"
#include "apps/build_info.h"
#include "apps/sequence_pairs.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

struct Features {
  std::string name, title;
  fs::path weights;  // empty: those that ship, or none
  std::string weights_hash;
};

// The files, each once.
std::vector<fs::path> WeightFiles(const BenchmarkRequest& request) {
  std::vector<fs::path> files;
  for (const fs::path& weights : request.weights) {
    if (!fs::is_regular_file(weights)) {
      throw InputError(fmt::format("--weights '{}': no such file", weights.string()));
    }
    const fs::path file = fs::canonical(weights);
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
  return files;
}

// "LIFT (mine)"; of files that share a name with their folders: "LIFT (run_a/weights)". Tables tell
// features apart by their titles.
std::vector<std::string> TitlesOf(const std::vector<fs::path>& files) {
  std::map<std::string, int> counts;
  for (const fs::path& file : files) ++counts[file.stem().string()];
  std::vector<std::string> titles;
  for (const fs::path& file : files) {
    const fs::path stem = file.stem();
    const fs::path name = counts[stem.string()] > 1 ? file.parent_path().filename() / stem : stem;
    titles.push_back(fmt::format("LIFT ({})", name.string()));
    if (std::ranges::count(titles, titles.back()) == 1) continue;
    throw InputError(fmt::format(
        "--weights: two files would both be '{}' in the tables: rename one of them or its folder",
        titles.back()));
  }
  return titles;
}

std::vector<Features> ChosenFeatures(const BenchmarkRequest& request) {
  std::vector<Features> chosen;
  const auto names = request.systems.empty() ? std::vector<std::string>{"orb", "sift", "lift"}
                                             : WithoutRepeats(request.systems);
  for (const std::string& name : names) {
    if (name == "orb") chosen.push_back({name, "ORB", {}, {}});
    if (name == "sift") chosen.push_back({name, "SIFT", {}, {}});
    if (name == "lift") {
      chosen.push_back({name, "LIFT", {}, Sha256Hex(ReadText(DefaultLiftWeights()))});
    }
    if (name == "orb" || name == "sift" || name == "lift") continue;
    throw InputError(fmt::format("--systems '{}': matching compares orb, sift and lift", name));
  }
  const std::vector<fs::path> files = WeightFiles(request);
  const std::vector<std::string> titles = TitlesOf(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    chosen.push_back({"lift", titles[i], files[i], Sha256Hex(ReadText(files[i]))});
  }
  return chosen;
}

void CheckRequest(const BenchmarkRequest& request) {
  if (!request.overrides.empty() || !request.conditions.empty()) {
    throw InputError("matching has neither --set nor --conditions: both are for runs");
  }
  if (request.pairs < 1) throw InputError("--pairs must be at least 1");
}

BenchmarkJob MakeJob(const BenchmarkRequest& request, const Features& features,
                     const BenchmarkSequence& sequence, const std::string& sequence_hash) {
  BenchmarkJob job;
  job.system = features.name;
  job.title = features.title;
  job.sequence = sequence.name;
  job.source = sequence.folder;
  job.weights = features.weights;
  job.frames = request.frames;
  job.pairs = request.pairs;
  const std::string identity =
      fmt::format("matching\n{}\n{}\n{}\n{}\n{}\n{}\n{}", features.name, features.title,
                  features.weights_hash, ProgramIdentity(), sequence_hash, job.frames, job.pairs);
  job.hash = Sha256Hex(identity).substr(0, 16);
  return job;
}

}  // namespace

BenchmarkPlan MakeMatchingPlan(const BenchmarkRequest& request) {
  CheckRequest(request);
  BenchmarkPlan plan;
  plan.suite = request.suite;
  plan.revision = kGitRevision;
  plan.frames = request.frames;
  plan.conditions = PairConditions();
  const std::vector<Features> chosen = ChosenFeatures(request);
  for (const Features& features : chosen) {
    plan.titles.push_back(features.title);
    const fs::path file = features.weights.empty() ? DefaultLiftWeights() : features.weights;
    if (features.name == "lift") {
      plan.hashes[WeightsKey(file, features.title)] = features.weights_hash;
    }
  }
  for (const BenchmarkSequence& sequence : ChosenSequences(request)) {
    plan.sequences.push_back(sequence.name);
    const std::string hash = SequenceIdentity(sequence.folder);
    plan.hashes["sequence " + sequence.name] = hash;
    for (const Features& features : chosen) {
      plan.jobs.push_back(MakeJob(request, features, sequence, hash));
    }
  }
  if (plan.jobs.empty()) {
    throw InputError("nothing to run: no sequence below " + request.data.string());
  }
  return plan;
}

}  // namespace lift_slam
