#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/benchmark_data.h"

namespace lift_slam {

// What a user asks `lift_slam benchmark` for.
struct BenchmarkRequest {
  std::string suite;
  std::filesystem::path data;
  std::vector<std::string> systems;     // names of presets or .yaml files; empty: the suite's
  std::vector<std::string> sequences;   // only these; empty: all of the suite
  std::vector<std::string> conditions;  // distortions; "none": as they are; empty: the suite's
  std::vector<std::string> overrides;   // key=value for every system
  std::string frames;                   // part of every sequence: FIRST:LAST:STEP
  std::filesystem::path variants;       // of the ablation: a file as configs/ablation.yaml
  std::vector<std::filesystem::path> weights;  // of matching: LIFT again with each
  int pairs = 20;                              // of matching: on each sequence and condition
  int runs = 5;
};

// One run of one system on one sequence, or matching of one kind of features over its pairs of
// images: everything that decides its result.
struct BenchmarkJob {
  std::string system, title;  // "adaptive", "Adaptive LIFT-SLAM"
  std::string sequence;       // "00", "MH_01"
  std::string distortion;     // empty: none
  int seed = 0;               // number of the run
  std::filesystem::path source, config;
  std::filesystem::path weights;  // empty: those that ship
  std::vector<std::string> overrides;
  std::string frames;
  int pairs = 0;  // of images to match; 0: a run
  // SHA-256 of settings, weights, vocabulary, program, content of the sequence, part of it, seed
  // and distortion, 16 digits: the name of the folder of results.
  std::string hash;

  std::string Condition() const { return distortion.empty() ? "none" : distortion; }
};

struct BenchmarkPlan {
  std::string suite, revision;
  std::string frames;  // part of every sequence; empty: all of it
  std::vector<std::string> titles, sequences, conditions;  // in the order of the tables
  std::vector<BenchmarkJob> jobs;
  // "TITLE|SEQUENCE" that a preset leaves out, since it was trained with the sequence.
  std::vector<std::string> skipped;
  std::vector<std::string> missing;  // sentences: sequences and weights that are not there
  // SHA-256 of the sequences' content and of weights, by "sequence 00" and WeightsKey.
  std::map<std::string, std::string> hashes;
};

inline constexpr const char* kBenchmarkSuites[] = {
    "kitti", "euroc", "rendered", "shared", "robustness", "thresholds", "ablation", "matching"};

// The values in their order, each once.
std::vector<std::string> WithoutRepeats(const std::vector<std::string>& values);

// "weights lift.safetensors of LIFT-SLAM": two systems may have files of one name.
std::string WeightsKey(const std::filesystem::path& file, const std::string& title);

// Those of the suite that the request does not leave out, missing ones included. Throws InputError
// for a name that the suite has not, and for a sequence that two folders may be.
std::vector<BenchmarkSequence> ChosenSequences(const BenchmarkRequest& request);

// Throws InputError for an unknown suite, system or distortion, and when nothing can be run.
BenchmarkPlan MakeBenchmarkPlan(const BenchmarkRequest& request);

// plan.json of a benchmark's folder. Throws InputError.
void WriteBenchmarkPlan(const BenchmarkPlan& plan, const std::filesystem::path& folder);
BenchmarkPlan ReadBenchmarkPlan(const std::filesystem::path& folder);

}  // namespace lift_slam
