#include "apps/benchmark_external.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/benchmark_truth.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

// Further than this from every frame, a pose is of none.
constexpr std::int64_t kMaxFrameDistanceNs = 20'000'000;

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

// Poses with a time alone become poses of frames.
void GiveIndices(const std::vector<std::int64_t>& times_ns, const fs::path& file,
                 Trajectory& trajectory) {
  if (times_ns.empty()) {
    throw InputError(fmt::format(
        "{}: poses with times, but the sequence has no times.txt to find their frames by",
        file.string()));
  }
  for (TrajectoryPose& pose : trajectory) {
    auto next = std::ranges::lower_bound(times_ns, pose.timestamp_ns);
    if (next == times_ns.end() ||
        (next != times_ns.begin() && pose.timestamp_ns - *(next - 1) < *next - pose.timestamp_ns)) {
      --next;
    }
    const bool is_near = std::abs(*next - pose.timestamp_ns) <= kMaxFrameDistanceNs;
    pose.frame_index = is_near ? next - times_ns.begin() : -1;
  }
}

// Poses outside the part that is run, or of no frame, take no part.
Trajectory ReadPoses(const fs::path& file, const BenchmarkTruth& truth) {
  Trajectory poses = ReadTrajectory(file).trajectory;
  if (truth.evaluation.association.method != AssociationMethod::kIndex) return poses;
  const bool has_indices =
      std::ranges::all_of(poses, [](const TrajectoryPose& p) { return p.frame_index >= 0; });
  if (!has_indices) GiveIndices(truth.frame_times_ns, file, poses);
  const std::int64_t first = truth.poses.front().frame_index, last = truth.poses.back().frame_index;
  std::erase_if(poses, [&](const TrajectoryPose& pose) {
    return pose.frame_index < first || pose.frame_index > last;
  });
  return poses;
}

BenchmarkRun Judge(const fs::path& file, const BenchmarkTruth& truth) {
  const Trajectory poses = ReadPoses(file, truth);
  EvaluationOptions options = truth.evaluation;
  options.estimate_lists_every_frame = false;
  options.frames_total =
      static_cast<int>(std::max<std::int64_t>(truth.num_frames, std::ssize(poses)));
  try {
    const EvaluationResult result = Evaluate(poses, truth.poses, options);
    BenchmarkRun run = RunFromResult(ToJson(result).dump(), file.string());
    run.aligned = result.aligned_estimate;
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
      runs.push_back(Judge(file, *truth));
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
