#include "apps/weights_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "apps/measure_weights_command.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/features/lift/lift_weights_import.h"
#include "lift_slam/nn/weight_file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

struct ImportArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;
  std::string detector = "aug";
  std::string descriptor = "F";
  std::vector<float> matching, nearest_wrong;
};

// Empty, or five ascending numbers.
std::array<float, 5> Quantiles(const char* option, const std::vector<float>& values) {
  std::array<float, 5> quantiles{};
  if (values.size() != quantiles.size() || !std::is_sorted(values.begin(), values.end()) ||
      !(values[0] >= 0)) {
    throw InputError(
        fmt::format("{} needs five ascending distances (the 5, 25, 50, 75 and 95 % "
                    "quantiles), not {}",
                    option, values));
  }
  std::copy(values.begin(), values.end(), quantiles.begin());
  return quantiles;
}

void Import(const ImportArguments& arguments) {
  LiftImport wanted;
  if (arguments.detector == "noaug") wanted.detector = ReleasedDetector::kNotAugmented;
  if (arguments.descriptor == Name(LiftTopology::kT)) wanted.topology = LiftTopology::kT;
  LiftWeights weights = ImportLiftWeights(arguments.files, wanted);
  if (!arguments.matching.empty() || !arguments.nearest_wrong.empty()) {
    weights.distances = {Quantiles("--matching", arguments.matching),
                         Quantiles("--nearest-wrong", arguments.nearest_wrong)};
  }
  WriteLiftWeights(weights, arguments.output);
  std::cout << fmt::format("{}: {}, SHA-256 {}\n", arguments.output.string(), weights.name,
                           weights.sha256);
}

std::string Describe(const InputNormalization& input) {
  return fmt::format("input (grey - {}) / {}", input.mean, input.scale);
}

std::size_t NumParameters(LiftWeights& weights, const std::string& module) {
  std::size_t count = 0;
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (parameter.name.starts_with(module + ".")) count += parameter.values.size();
  }
  return count;
}

void PrintInfo(const std::filesystem::path& file) {
  LiftWeights weights = ReadLiftWeights(file);
  const auto print = [](const char* name, const std::string& value) {
    std::cout << fmt::format("{:<15}{}\n", name, value);
  };
  const auto print_module = [&](const char* module, const InputNormalization& input) {
    print(module,
          fmt::format("{} parameters, {}", NumParameters(weights, module), Describe(input)));
  };
  print("name", weights.name);
  print("topology", std::string(Name(weights.topology)));
  print("SHA-256", weights.sha256);
  print_module("detector", weights.detector_input);
  if (weights.orientation) {
    print_module("orientation", weights.orientation_input);
  } else {
    print("orientation", "none (upright patches)");
  }
  print_module("descriptor", weights.descriptor_input);
  print("int8 ranges", weights.descriptor_ranges.empty()
                           ? "not measured"
                           : fmt::format("{}", fmt::join(weights.descriptor_ranges, " ")));
  if (weights.distances) {
    print("matching", fmt::format("{} (5, 25, 50, 75, 95 % of distances)",
                                  fmt::join(weights.distances->matching, " ")));
    print("nearest wrong", fmt::format("{}", fmt::join(weights.distances->nearest_wrong, " ")));
  } else {
    print("distances", "not measured");
  }
  print("provenance", weights.provenance);
}

void AddImport(CLI::App& weights) {
  CLI::App* command = weights.add_subcommand(
      "import", "Convert weights that the authors of LIFT released (HDF5; academic use only)");
  auto arguments = std::make_shared<ImportArguments>();
  command
      ->add_option("FILES", arguments->files,
                   "new-CNN3-picc-iter-56k.h5 (descriptor T), tf-lift-release.h5 (descriptor F "
                   "and detectors), or both")
      ->required();
  command->add_option("--output", arguments->output, "File to write (.safetensors)")->required();
  command
      ->add_option("--detector", arguments->detector,
                   "aug: trained with random rotations; noaug: without")
      ->check(CLI::IsMember({"aug", "noaug"}))
      ->capture_default_str();
  command->add_option("--descriptor", arguments->descriptor, "Topology of the descriptor")
      ->check(CLI::IsMember({"F", "T"}))
      ->capture_default_str();
  command
      ->add_option("--matching", arguments->matching,
                   "Measured distances of matches: 5, 25, 50, 75, 95 % quantiles")
      ->expected(5);
  command
      ->add_option("--nearest-wrong", arguments->nearest_wrong,
                   "The same of the nearest that does not match")
      ->expected(5);
  command->callback([arguments] { Import(*arguments); });
}

void AddInfo(CLI::App& weights) {
  CLI::App* command = weights.add_subcommand("info", "Print what a file of weights holds");
  auto file = std::make_shared<std::filesystem::path>();
  command->add_option("FILE", *file, "LIFT weights (.safetensors)")->required();
  command->callback([file] { PrintInfo(*file); });
}

}  // namespace

void AddWeightsCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("weights", "Import, measure and describe network weights");
  command->require_subcommand(1);
  AddImport(*command);
  AddMeasureWeightsCommands(*command);
  AddInfo(*command);
}

}  // namespace lift_slam
