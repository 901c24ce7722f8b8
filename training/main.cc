#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>

#include "apps/exit_code.h"
#include "lift_slam/util/input_error.h"
#include "training/fine_tune_command.h"
#include "training/prepare_command.h"
#include "training/train_command.h"
#include "training/weights_commands.h"

namespace lift_slam::training {
namespace {

void AddEverything(CLI::App& app) {
  app.description("Trains the networks of LIFT (docs/training.md).");
  app.footer(
      "Examples:\n"
      "  lift_slam_train prepare photographs images --output sets/photographs\n"
      "  lift_slam_train train descriptor --data sets/photographs --output runs/descriptor\n"
      "'lift_slam_train COMMAND --help' explains one command.\n"
      "Exit codes: 0 done, 1 bad input, 2 internal error.");
  app.require_subcommand(1);
  AddPrepareCommand(app);
  AddTrainCommand(app);
  AddFineTuneCommand(app);
  AddWeightsCommands(app);
}

// A batch's activations are 100 MB, made anew at every step: given back to the system each time,
// fetching them again costs more than all of the arithmetic.
void KeepMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_TOP_PAD, 1 << 26);
}

void PrintError(const std::string& message) {
  std::cout.flush();
  std::fputs(fmt::format("lift_slam_train: {}\n", message).c_str(), stderr);
}

int Main(int argc, char** argv) {
  KeepMemory();
  // libtorch takes AVX2 for the best of every CPU unless told otherwise.
  setenv("ATEN_CPU_CAPABILITY", __builtin_cpu_supports("avx512f") ? "avx512" : "avx2", 0);
  try {
    CLI::App app("", "lift_slam_train");
    AddEverything(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? kDone : kBadInput;
    }
    return kDone;
  } catch (const InputError& error) {
    PrintError(error.what());
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {  // no permission, links in a circle
    PrintError(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return kBadInput;
  } catch (const std::bad_alloc&) {
    PrintError("not enough memory; try a smaller batch");
  } catch (const std::exception& error) {
    PrintError(fmt::format("internal error: {}", error.what()));
  }
  return kInternalError;
}

}  // namespace
}  // namespace lift_slam::training

int main(int argc, char** argv) { return lift_slam::training::Main(argc, argv); }
