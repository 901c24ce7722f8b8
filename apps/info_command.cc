#include "apps/info_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "apps/build_info.h"
#include "lift_slam/util/shipped_file.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

void PrintInfo() {
  const std::vector<std::string> features = CpuFeatures();
  const double memory_gib = static_cast<double>(TotalMemoryBytes()) / (1 << 30);
  const std::pair<const char*, std::string> rows[] = {
      {"lift_slam", kProgramVersion},
      {"git revision", kGitRevision},
      {"build", fmt::format("{}, {}", kBuildType, kCompiler)},
      {"OpenCV", kOpenCvVersion},
      {"Eigen", kEigenVersion},
      {"Ceres", kCeresVersion},
      {"CPU", CpuName()},
      {"CPU features", features.empty() ? "none" : fmt::format("{}", fmt::join(features, " "))},
      {"threads", std::to_string(NumHardwareThreads())},
      {"memory", fmt::format("{:.1f} GiB", memory_gib)},
      {"program", ProgramPath().value_or("unknown").string()},
      {"shipped files", ShippedFile("weights").parent_path().string()},
      {"working folder", std::filesystem::current_path().string()},
  };
  for (const auto& [name, value] : rows) std::cout << fmt::format("{:<15}{}\n", name, value);
}

}  // namespace

void AddInfoCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "info", "Print versions, CPU features, memory and paths (for bug reports)");
  command->callback(PrintInfo);
}

}  // namespace lift_slam
