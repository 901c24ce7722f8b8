#include "apps/benchmark_jobs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "apps/exit_code.h"
#include "apps/progress_bar.h"
#include "apps/stop_signal.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/util/parallel_for.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> MatchingCommandLine(const BenchmarkJob& job, const fs::path& output) {
  std::vector<std::string> words = {"lift_slam", "match-sequence", job.source.string(),
                                    "--output",  output.string(),  "--features",
                                    job.system,  "--pairs",        std::to_string(job.pairs)};
  if (!job.weights.empty()) words.insert(words.end(), {"--weights", job.weights.string()});
  if (!job.frames.empty()) words.insert(words.end(), {"--frames", job.frames});
  return words;
}

std::vector<std::string> CommandLine(const BenchmarkJob& job, const fs::path& output,
                                     const fs::path& feature_cache) {
  if (job.pairs > 0) return MatchingCommandLine(job, output);
  std::vector<std::string> words = {"lift_slam",         "run",           job.source.string(),
                                    "--output",          output.string(), "--config",
                                    job.config.string(), "--seed",        std::to_string(job.seed)};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--weights", job.weights.string());
  add("--distort", job.distortion);
  add("--frames", job.frames);
  add("--feature-cache", feature_cache.string());
  for (const std::string& setting : job.overrides) add("--set", setting);
  return words;
}

// The child's side of the fork: only calls that are safe after a fork of a threaded program.
[[noreturn]] void Become(char* const* words, int console) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a killed benchmark leaves nobody writing behind
  dup2(console, STDOUT_FILENO);
  dup2(console, STDERR_FILENO);
  execv("/proc/self/exe", words);
  _exit(127);
}

// The exit code of this program with other arguments; nothing when it was stopped or killed.
std::optional<int> RunChild(std::vector<std::string> words, const fs::path& console_path,
                            const StopSignal& stop) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int console = open(console_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (console < 0) throw InputError(fmt::format("{}: cannot be written", console_path.string()));
  const pid_t child = fork();
  if (child == 0) Become(pointers.data(), console);
  close(console);
  if (child < 0) throw InputError("no process can be started (limit reached?)");
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (stop.Requested()) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

// A run that a signal ended early has results, but not those that were asked for.
bool IsComplete(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / "result.json", error)) return false;
  const auto json = nlohmann::json::parse(ReadText(folder / "result.json"), nullptr, false);
  return json.is_object() && !json.value("interrupted", true);
}

std::string HostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// Two processes that share a folder of results keep apart.
std::string OwnMark() { return fmt::format(".{}.{}", HostName(), getpid()); }

// Folders of processes of this host that ended without putting them into place.
void RemoveAbandoned(const fs::path& running) {
  const std::string host = "." + HostName() + ".";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(running, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.find(host);
    if (at == std::string::npos) continue;
    const auto pid = ParseIndex(name.substr(at + host.size()));
    if (pid && kill(static_cast<pid_t>(*pid), 0) != 0 && errno == ESRCH) {
      fs::remove_all(entry.path(), error);
    }
  }
}

void MoveFolder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  CreateFolder(to.parent_path());
  fs::remove_all(to, error);
  fs::rename(from, to, error);
  if (error) {
    throw InputError(
        fmt::format("{}: cannot be moved to {}: {}", from.string(), to.string(), error.message()));
  }
}

JobOutcome RunJob(const BenchmarkJob& job, const fs::path& folder, const fs::path& feature_cache,
                  const StopSignal& stop) {
  if (IsFinished(folder, job)) return JobOutcome::kWasFinished;
  if (stop.Requested()) return JobOutcome::kStopped;
  const fs::path running = folder / "running" / (job.hash + OwnMark());
  std::error_code error;
  fs::remove_all(running, error);
  CreateFolder(running);
  const auto exit_code =
      RunChild(CommandLine(job, running, feature_cache), running / "console.txt", stop);
  if (stop.Requested()) {
    fs::remove_all(running, error);
    return JobOutcome::kStopped;
  }
  const bool has_result = exit_code && (*exit_code == kDone || *exit_code == kNoTrajectory);
  if (IsFinished(folder, job)) {  // another process was faster
    fs::remove_all(running, error);
    return JobOutcome::kWasFinished;
  }
  if (has_result && IsComplete(running)) {
    MoveFolder(running, ResultFolder(folder, job));
    return JobOutcome::kFinished;
  }
  MoveFolder(running, folder / "failed" / job.hash);
  return JobOutcome::kFailed;
}

std::string NameOf(const BenchmarkJob& job) {
  return fmt::format("{}, {}{}, run {}", job.system, job.sequence,
                     job.distortion.empty() ? "" : " " + job.distortion, job.seed + 1);
}

}  // namespace

fs::path ResultFolder(const fs::path& folder, const BenchmarkJob& job) {
  return folder / "results" / job.hash;
}

bool IsFinished(const fs::path& folder, const BenchmarkJob& job) {
  std::error_code error;
  return fs::is_regular_file(ResultFolder(folder, job) / "result.json", error);
}

BatchResult RunJobs(const std::vector<BenchmarkJob>& jobs, const fs::path& folder, int num_parallel,
                    const fs::path& feature_cache) {
  std::vector<BenchmarkJob> open_jobs;
  for (const BenchmarkJob& job : jobs) {
    if (!IsFinished(folder, job)) open_jobs.push_back(job);
  }
  BatchResult batch;
  batch.were_finished = static_cast<int>(jobs.size() - open_jobs.size());
  if (open_jobs.empty()) return batch;
  RemoveAbandoned(folder / "running");
  const StopSignal stop;
  ProgressBar bar;
  Progress progress;
  progress.unit = "runs";
  progress.frames_total = static_cast<std::int64_t>(open_jobs.size());
  progress.keyframes = kNoMap;
  std::mutex mutex;  // of everything the workers share
  ParallelFor(open_jobs.size(), num_parallel, [&](std::size_t i) {
    {
      const std::lock_guard lock(mutex);
      progress.state = NameOf(open_jobs[i]);
      bar.Update(progress);
    }
    const JobOutcome outcome = RunJob(open_jobs[i], folder, feature_cache, stop);
    const std::lock_guard lock(mutex);
    batch.finished += outcome == JobOutcome::kFinished ? 1 : 0;
    batch.were_finished += outcome == JobOutcome::kWasFinished ? 1 : 0;
    batch.failed += outcome == JobOutcome::kFailed ? 1 : 0;
    progress.frames_done += outcome == JobOutcome::kStopped ? 0 : 1;
    bar.Update(progress);
  });
  batch.stopped = stop.Requested();
  progress.state = batch.stopped ? "stopped" : "done";
  bar.Finish(progress);
  return batch;
}

}  // namespace lift_slam
