#include "apps/benchmark_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "apps/benchmark_document.h"
#include "apps/benchmark_external.h"
#include "apps/benchmark_jobs.h"
#include "apps/benchmark_outcome.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"
#include "apps/benchmark_usage.h"
#include "apps/exit_code.h"
#include "apps/pdf_figure.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/util/shipped_file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

struct BenchmarkArguments {
  std::vector<std::string> words;  // SUITE, "plan SUITE", "run-job K", "merge" or "results"
  BenchmarkRequest request;
  fs::path output, publications = ShippedFile("configs/paper_results.yaml");
  fs::path feature_cache;             // empty: none
  std::vector<std::string> external;  // NAME=FOLDER
  std::vector<fs::path> from;         // folders of benchmarks, for "results"
  int jobs = 1;
};

// Each name becomes a system after ours.
void AddExternal(const BenchmarkArguments& arguments, BenchmarkPlan& plan,
                 std::vector<BenchmarkRun>& runs) {
  for (const std::string& argument : arguments.external) {
    std::vector<BenchmarkRun> more = ReadExternalRuns(argument, plan);
    const std::string& title = more.front().title;
    if (std::ranges::find(plan.titles, title) != plan.titles.end()) {
      throw InputError(fmt::format("--external: there is a system '{}' already", title));
    }
    plan.titles.push_back(title);
    std::ranges::move(more, std::back_inserter(runs));
  }
}

// Beside the SVG files, as far as it can be done; one sentence when not.
void WritePdfs(const std::vector<BenchmarkPicture>& pictures, const fs::path& folder) {
  for (const BenchmarkPicture& picture : pictures) {
    const fs::path file = (folder / picture.file_name).replace_extension(".pdf");
    const PdfOutcome outcome = WritePdf(picture.svg_file, file);
    if (outcome == PdfOutcome::kWritten) continue;
    std::cout << "warning     figures as SVG alone: rsvg-convert "
              << (outcome == PdfOutcome::kNoConverter
                      ? "is not there (Debian's package librsvg2-bin)\n"
                      : fmt::format("failed on {}\n", picture.file_name));
    return;
  }
}

void WritePictures(const std::vector<BenchmarkPicture>& pictures, const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // of an earlier plan
  if (pictures.empty()) return;
  CreateFolder(folder);
  for (const BenchmarkPicture& picture : pictures) {
    WriteTextAtomically(folder / picture.file_name, picture.svg_file);
  }
  WritePdfs(pictures, folder);
}

void WriteTables(const BenchmarkTables& tables, const fs::path& folder) {
  WriteTextAtomically(folder / "tables.md", tables.markdown);
  WriteTextAtomically(folder / "tables.csv", tables.csv);
  WriteTextAtomically(folder / "tables.tex", tables.latex);
  WriteTextAtomically(folder / "tables.html", tables.html);
  std::cout << tables.markdown
            << fmt::format("tables      {}\n", (folder / "tables.html").string());
}

void Merge(const BenchmarkArguments& arguments) {
  BenchmarkPlan plan = ReadBenchmarkPlan(arguments.output);
  if (plan.suite == "matching" && !arguments.external.empty()) {
    throw InputError("--external gives trajectories, and matching has none");
  }
  const BenchmarkOutcome outcome = [&] {
    if (plan.suite == "matching") return MatchingOutcome(plan, arguments.output);
    std::vector<BenchmarkRun> runs = ReadBenchmarkRuns(plan, arguments.output);
    AddExternal(arguments, plan, runs);
    return RunsOutcome(plan, runs, arguments.publications);
  }();
  WritePictures(outcome.pictures, arguments.output / "figures");
  WriteTables(outcome.tables, arguments.output);
}

BenchmarkPlan Plan(const BenchmarkArguments& arguments) {
  if (arguments.request.data.empty()) throw InputError("benchmark needs --data ROOT");
  const BenchmarkPlan plan = MakeBenchmarkPlan(arguments.request);
  CreateFolder(arguments.output);
  WriteBenchmarkPlan(plan, arguments.output);
  for (const std::string& sentence : plan.missing) std::cout << "missing     " << sentence << "\n";
  std::cout << fmt::format("plan        {} runs, {}\n", plan.jobs.size(),
                           (arguments.output / "plan.json").string());
  return plan;
}

// How many runs broke. Throws CLI::RuntimeError when a signal came.
int Run(const std::vector<BenchmarkJob>& jobs, const BenchmarkArguments& arguments) {
  const BatchResult batch =
      RunJobs(jobs, arguments.output, arguments.jobs, arguments.feature_cache);
  std::cout << fmt::format("runs        {} done now, {} were done, {} failed\n", batch.finished,
                           batch.were_finished, batch.failed);
  if (batch.stopped) throw CLI::RuntimeError(kStopped);
  if (batch.failed > 0) {
    std::cout << fmt::format("            why: {}/*/console.txt\n",
                             (arguments.output / "failed").string());
  }
  return batch.failed;
}

// Once all that there is has been written.
void EndWith(int num_failed) {
  if (num_failed > 0) throw CLI::RuntimeError(kBadInput);
}

void RunOne(const BenchmarkArguments& arguments) {
  const BenchmarkPlan plan = ReadBenchmarkPlan(arguments.output);
  const auto number = ParseIndex(arguments.words.back());
  if (!number || *number < 1 || *number > static_cast<std::int64_t>(plan.jobs.size())) {
    throw InputError(fmt::format("run-job: expected a number from 1 to {}", plan.jobs.size()));
  }
  EndWith(Run({plan.jobs[static_cast<std::size_t>(*number - 1)]}, arguments));
}

void WriteResults(const BenchmarkArguments& arguments) {
  if (arguments.from.empty()) throw InputError("benchmark results needs --from FOLDER...");
  if (arguments.output.extension() != ".md") {
    throw InputError("benchmark results writes a document: --output must end in .md");
  }
  WriteBenchmarkDocument(arguments.from, arguments.publications, arguments.output);
  std::cout << fmt::format("results     {}\n", arguments.output.string());
}

void Benchmark(BenchmarkArguments arguments) {
  if (arguments.jobs < 1) throw InputError("--jobs must be at least 1");
  const std::string& verb = arguments.words.front();
  if (verb == "merge") return Merge(arguments);
  if (verb == "results") return WriteResults(arguments);
  if (verb == "run-job") return RunOne(arguments);
  arguments.request.suite = arguments.words.back();
  const BenchmarkPlan plan = Plan(arguments);
  if (verb == "plan") return;
  const int num_failed = Run(plan.jobs, arguments);
  Merge(arguments);
  EndWith(num_failed);
}

void AddOptions(CLI::App& command, BenchmarkArguments& arguments) {
  BenchmarkRequest& request = arguments.request;
  command.add_option("WHAT", arguments.words, "SUITE, plan SUITE, run-job K, merge or results")
      ->required()
      ->expected(1, 2);
  command.add_option("--data", request.data, "Folder that holds the sequences, at any depth");
  command
      .add_option("--output", arguments.output,
                  "Folder for plan, runs and tables; the document of results (.md)")
      ->required();
  command.add_option("--systems", request.systems,
                     "Presets (configs/systems) or .yaml files (default: those of the paper)");
  command.add_option("--variants", request.variants,
                     "Of the ablation (YAML, default configs/ablation.yaml); --systems chooses "
                     "among their names");
  command.add_option("--weights", request.weights, "Of matching: LIFT again with these files");
  command.add_option("--pairs", request.pairs, "Of matching: first images of each sequence")
      ->capture_default_str();
  command.add_option("--sequences", request.sequences,
                     "Only these, of the suite or others below --data");
  command.add_option("--conditions", request.conditions,
                     "Distortions, 'none' for images as they are (default: the suite's)");
  command.add_option("--runs", request.runs, "Of each, with seeds 0, 1, ... (default 5)");
  command.add_option("--jobs", arguments.jobs, "Runs at a time (default 1)");
  command
      .add_option("--feature-cache", arguments.feature_cache,
                  "Folder that keeps features: further runs find them there (no times then)")
      ->type_name("FOLDER");
  command.add_option("--frames", request.frames, "Part of every sequence: FIRST:LAST:STEP");
  command.add_option("--set", request.overrides, "KEY=VALUE for every system; may be repeated")
      ->allow_extra_args(false);
  command
      .add_option("--external", arguments.external,
                  "Trajectories of another system, a file for each sequence (00.txt); as NAME in "
                  "tables and figures")
      ->type_name("NAME=FOLDER")
      ->allow_extra_args(false);
  command.add_option("--from", arguments.from, "Of results: folders of benchmarks, in order");
  command.add_option("--publications", arguments.publications,
                     "Numbers of others to show beside ours (YAML; '' for none)");
}

}  // namespace

void AddBenchmarkCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "benchmark", "Systems on the sequences of a suite, several runs each, as tables");
  const auto arguments = std::make_shared<BenchmarkArguments>();
  arguments->request.variants = ShippedFile("configs/ablation.yaml");
  AddOptions(*command, *arguments);
  command->footer(
      "Suites: kitti, euroc, rendered, shared (whatever is there), robustness, thresholds, "
      "ablation,\n"
      "matching (pairs of images).\n"
      "Runs that are finished are never repeated; a benchmark that was stopped goes on.\n"
      "Exit codes: 0 done, 1 bad input or a run that broke (the tables of the others are written), "
      "130 stopped.\n"
      "Examples:\n"
      "  lift_slam benchmark kitti --data ~/kitti --output bench --jobs 2\n"
      "  lift_slam benchmark plan euroc --data ~/euroc --output bench\n"
      "  seq 55 | parallel lift_slam benchmark run-job {} --output bench\n"
      "  lift_slam benchmark merge --output bench --external DeepVO=~/deepvo\n"
      "  lift_slam benchmark results --from bench bench2 --output docs/results.md");
  command->callback([command, arguments] {
    CheckBenchmarkUsage(*command, arguments->words);
    Benchmark(*arguments);
  });
}

}  // namespace lift_slam
