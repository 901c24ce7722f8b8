#include "apps/benchmark_external.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/benchmark_truth.h"
#include "apps/program_options.h"
#include "apps/sequence_truth.h"
#include "lift_slam/evaluation/association.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

// Further than this from every frame, a pose is of none.
constexpr double kMaxFrameDistanceMs = 20.0;

bool IsTrajectoryOf(const fs::path& file, const std::string& sequence) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  const bool fits = stem == sequence || stem.starts_with(sequence + "_");
  return fits && (extension == ".txt" || extension == ".tum" || extension == ".kitti" ||
                  extension == ".csv");
}

fs::path FindTrajectory(const fs::path& folder, const std::string& sequence) {
  std::set<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && IsTrajectoryOf(entry.path(), sequence)) {
      found.insert(entry.path());
    }
  }
  return found.empty() ? fs::path() : *found.begin();
}

// The folder itself, or its numbered folders: a run each.
std::vector<fs::path> RunFolders(const fs::path& folder) {
  std::set<std::pair<std::int64_t, fs::path>> numbered;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto number = ParseIndex(entry.path().filename().string());
    if (entry.is_directory() && number) numbered.emplace(*number, entry.path());
  }
  if (numbered.empty()) return {folder};
  std::vector<fs::path> folders;
  for (const auto& [number, path] : numbered) folders.push_back(path);
  return folders;
}

// As our own runs of the job are judged.
SequenceTruth TruthOfJob(const BenchmarkJob& job, const BenchmarkTruth& truth) {
  ProgramOptions options;
  ConfigureOptions(job.config, job.overrides, MakeOptionRoot(options));
  return TruthOf(truth.sequence, options.evaluation);
}

// How poses of a file find their frames: by index as far as they have one, else by time.
AssociationOptions PairingWithFrames(const Trajectory& poses, const SequenceInfo& sequence,
                                     AssociationOptions options) {
  options.interpolate = false;
  const bool has_indices =
      std::ranges::all_of(poses, [](const TrajectoryPose& p) { return p.frame_index >= 0; });
  if (options.method != AssociationMethod::kIndex || has_indices) return options;
  const bool has_times = sequence.format != SequenceFormat::kKittiOdometry ||
                         fs::is_regular_file(sequence.path / "times.txt");
  if (!has_times) {
    throw InputError("poses with times, but the sequence has no times.txt to find their frames by");
  }
  options = {};
  options.method = AssociationMethod::kTime;
  options.max_time_difference_ms = kMaxFrameDistanceMs;
  return options;
}

// One entry for each frame that is run, as our own runs have: the nearest pose, each of them at
// most once, or none.
Trajectory PosesOfFrames(const Trajectory& poses, const SequenceInfo& sequence,
                         const AssociationOptions& judged_by) {
  const AssociationOptions pairing = PairingWithFrames(poses, sequence, judged_by);
  Trajectory entries;
  for (const FrameStamp& frame : sequence.frames) {
    TrajectoryPose& entry = entries.emplace_back();
    entry.frame_index = frame.frame_index;
    entry.timestamp_ns = frame.timestamp_ns;
  }
  std::ranges::stable_sort(entries, {}, &TrajectoryPose::timestamp_ns);
  const std::vector<PosePair> pairs = Associate(poses, entries, pairing).pairs;
  const bool by_time = judged_by.method == AssociationMethod::kTime;
  for (TrajectoryPose& entry : entries) {
    entry.state = PoseState::kLost;
    if (by_time) entry.timestamp_ns -= std::llround(judged_by.offset_s * 1e9);
  }
  for (const PosePair& pair : pairs) {
    TrajectoryPose& entry = entries[pair.reference_index];
    entry.state = PoseState::kOk;
    entry.world_from_cam = pair.estimate;
    if (by_time) entry.timestamp_ns = poses[pair.estimate_index].timestamp_ns;
  }
  std::ranges::stable_sort(entries, {}, &TrajectoryPose::timestamp_ns);
  return entries;
}

BenchmarkRun Judge(const fs::path& file, const SequenceInfo& sequence, const SequenceTruth& truth) {
  const Trajectory poses = ReadTrajectory(file).trajectory;
  EvaluationOptions options = truth.options;
  options.estimate_lists_every_frame = true;
  try {
    const EvaluationResult result =
        Evaluate(PosesOfFrames(poses, sequence, options.association), truth.poses, options);
    BenchmarkRun run = RunFromResult(ToJson(result).dump(), file.string());
    run.aligned = result.aligned_estimate;
    std::erase_if(run.aligned,
                  [](const TrajectoryPose& pose) { return pose.state != PoseState::kOk; });
    return run;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

std::vector<BenchmarkRun> ReadExternalRuns(const std::string& argument, const BenchmarkPlan& plan) {
  const std::size_t equals = argument.find('=');
  const fs::path folder = equals == std::string::npos ? "" : argument.substr(equals + 1);
  if (equals == 0 || equals == std::string::npos || !fs::is_directory(folder)) {
    throw InputError(
        fmt::format("--external '{}': expected NAME=FOLDER with a folder that exists", argument));
  }
  std::vector<BenchmarkRun> runs;
  for (const std::string& sequence : plan.sequences) {
    const auto job = std::ranges::find(plan.jobs, sequence, &BenchmarkJob::sequence);
    if (job == plan.jobs.end()) continue;
    std::optional<BenchmarkTruth> truth;
    int seed = 0;
    for (const fs::path& run_folder : RunFolders(folder)) {
      const fs::path file = FindTrajectory(run_folder, sequence);
      if (file.empty()) continue;
      if (!truth) truth = LoadBenchmarkTruth(*job);
      if (!truth || truth->poses.empty()) continue;  // nothing to judge it by
      runs.push_back(Judge(file, truth->sequence, TruthOfJob(*job, *truth)));
      runs.back().title = argument.substr(0, equals);
      runs.back().sequence = sequence;
      runs.back().condition = "none";
      runs.back().seed = seed++;
    }
  }
  if (!runs.empty()) return runs;
  throw InputError(fmt::format(
      "--external '{}': no trajectory of a sequence of the benchmark with ground truth, such as "
      "{}.txt",
      argument, plan.sequences.empty() ? "00" : plan.sequences.front()));
}

}  // namespace lift_slam
