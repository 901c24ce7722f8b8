#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>

#include "apps/benchmark_command.h"
#include "apps/benchmark_features_command.h"
#include "apps/build_info.h"
#include "apps/config_command.h"
#include "apps/distort_command.h"
#include "apps/evaluate_command.h"
#include "apps/exit_code.h"
#include "apps/extract_command.h"
#include "apps/info_command.h"
#include "apps/match_command.h"
#include "apps/match_sequence_command.h"
#include "apps/render_command.h"
#include "apps/report_command.h"
#include "apps/run_command.h"
#include "apps/synthesize_command.h"
#include "apps/vocabulary_command.h"
#include "apps/weights_command.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"

namespace lift_slam {
namespace {

// The sub-commands, in the order of --help.
constexpr void (*kCommands[])(CLI::App&) = {
    AddRunCommand,           AddEvaluateCommand,
    AddReportCommand,        AddBenchmarkCommand,
    AddRenderCommand,        AddSynthesizeCommand,
    AddExtractCommand,       AddMatchCommand,
    AddDistortCommand,       AddBenchmarkFeaturesCommand,
    AddWeightsCommand,       AddVocabularyCommand,
    AddConfigCommand,        AddInfoCommand,
    AddMatchSequenceCommand,
};

void AddEverything(CLI::App& app) {
  app.description("Monocular visual SLAM: from an image sequence to a trajectory and a map.");
  app.footer(
      "Examples:\n"
      "  lift_slam run ~/kitti/sequences/00 --output runs/00\n"
      "  lift_slam run drive.mp4 --camera camera.yaml --output runs/drive\n"
      "  lift_slam evaluate --reference truth.tum --estimate runs/00/trajectory.tum\n"
      "'lift_slam COMMAND --help' explains one command.\n"
      "Exit codes: 0 done, 1 bad input, 2 internal error, 3 no trajectory (failed or lost).");
  app.set_version_flag("--version",
                       fmt::format("lift_slam {} ({})", kProgramVersion, kGitRevision));
  app.require_subcommand(1);
  for (const auto add : kCommands) add(app);
}

void PrintError(const std::string& message) {
  std::cout.flush();
  std::fputs(fmt::format("lift_slam: {}\n", message).c_str(), stderr);
}

// CLI11 calls an unknown first word an unexpected argument; here it is an unknown command.
void CheckCommandName(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == argv[1]) return;
    names.push_back(command->get_name());
  }
  throw InputError(
      fmt::format("unknown command '{}'; the nearest known is '{}' ('lift_slam --help' "
                  "lists all)",
                  argv[1], NearestName(argv[1], names)));
}

int HandleParseError(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
  std::string command = "lift_slam";
  for (const CLI::App* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  PrintError(fmt::format("{} ('{} --help' explains)", error.what(), command));
  return kBadInput;
}

void FlushOutput() {
  std::cout.flush();
  if (!std::cout) throw InputError("standard output cannot be written (disk full?)");
}

// Parses the command line and runs the chosen command within.
int ParseAndRun(CLI::App& app, int argc, const char* const* argv) {
  int code = kDone;
  try {
    CheckCommandName(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& ending) {
    code = ending.get_exit_code();
  } catch (const CLI::ParseError& error) {
    code = HandleParseError(app, error);
  }
  FlushOutput();
  return code;
}

int Main(int argc, const char* const* argv) {
  try {
    CLI::App app("", "lift_slam");
    AddEverything(app);
    return ParseAndRun(app, argc, argv);
  } catch (const InputError& error) {
    PrintError(error.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {  // no permission, links in a circle
    PrintError(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return kBadInput;
  } catch (const std::bad_alloc&) {
    PrintError("not enough memory for this input.");
  } catch (const std::exception& error) {
    PrintError(
        fmt::format("internal error: {}\nThis is a bug: please report it, with the command "
                    "line and what 'lift_slam info' prints.",
                    error.what()));
  }
  return kInternalError;
}

}  // namespace
}  // namespace lift_slam

int main(int argc, char** argv) { return lift_slam::Main(argc, argv); }
