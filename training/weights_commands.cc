#include "training/weights_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "lift_slam/nn/half_float.h"
#include "lift_slam/util/input_error.h"
#include "training/patch_sampler.h"
#include "training/stage_network.h"
#include "training/weights_calibration.h"

namespace lift_slam::training {
namespace {

struct AssembleArguments {
  std::filesystem::path descriptor, orientation, detector, output;
  std::string name = "default";
};

struct CalibrateArguments {
  std::filesystem::path weights, output;
  std::vector<std::string> data;
  int batches = 64;
  double nearest_wrong = 0.0;
};

void CheckInput(const std::filesystem::path& path, const InputNormalization& input) {
  if (input != InputNormalization{}) {
    throw InputError(fmt::format("{}: its input is not (grey - 128) / 128 as of our own training",
                                 path.string()));
  }
}

// Two of the 2.3 million parameters are in one layer: 16 bits each halve the file.
void RoundOrientation(LiftWeights& weights) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (parameter.name != "orientation.fc1.weight") continue;
    for (float& value : parameter.values) value = nn::FromHalf(nn::ToHalf(value));
  }
}

void Assemble(const AssembleArguments& arguments) {
  LiftWeights weights = ReadLiftWeights(arguments.descriptor);
  LiftWeights orientation = ReadLiftWeights(arguments.orientation);
  LiftWeights detector = ReadLiftWeights(arguments.detector);
  if (!orientation.orientation) {
    throw InputError(fmt::format("{}: has no orientation network", arguments.orientation.string()));
  }
  CheckInput(arguments.orientation, orientation.orientation_input);
  CheckInput(arguments.detector, detector.detector_input);
  TakeNetwork(Stage::kOrientation, orientation, weights);
  TakeNetwork(Stage::kDetector, detector, weights);
  weights.name = arguments.name;
  weights.provenance = "descriptor: " + weights.provenance +
                       "\norientation: " + orientation.provenance +
                       "\ndetector: " + detector.provenance;
  weights.distances.reset();
  RoundOrientation(weights);
  WriteLiftWeights(weights, arguments.output);
  std::cout << fmt::format("{}: SHA-256 {}\n", arguments.output.string(), weights.sha256);
}

void Calibrate(const CalibrateArguments& arguments) {
  LiftWeights weights = ReadLiftWeights(arguments.weights);
  CheckInput(arguments.weights, weights.descriptor_input);
  if (weights.topology != LiftTopology::kF) {
    throw InputError(
        fmt::format("{}: only topology F can be measured here", arguments.weights.string()));
  }
  const auto sets = OpenTrainingSets(arguments.data);
  CalibrateDescriptor(sets, {.batches = arguments.batches}, arguments.nearest_wrong, weights);
  WriteLiftWeights(weights, arguments.output.empty() ? arguments.weights : arguments.output);
  std::cout << fmt::format(
      "matching      {:.3f} (5, 25, 50, 75, 95 % of distances)\n"
      "nearest wrong {:.3f}\n",
      fmt::join(weights.distances->matching, " "),
      fmt::join(weights.distances->nearest_wrong, " "));
}

}  // namespace

void AddWeightsCommands(CLI::App& app) {
  CLI::App* assemble =
      app.add_subcommand("assemble", "Put the networks of several runs into one file of weights");
  auto parts = std::make_shared<AssembleArguments>();
  assemble->add_option("--descriptor", parts->descriptor, "Weights with the descriptor")
      ->required();
  assemble->add_option("--orientation", parts->orientation, "With the orientation")->required();
  assemble->add_option("--detector", parts->detector, "With the detector")->required();
  assemble->add_option("--output", parts->output, "File to write (.safetensors)")->required();
  assemble->add_option("--name", parts->name, "Of the weights")->capture_default_str();
  assemble->callback([parts] { Assemble(*parts); });

  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Measure distances of descriptors and store their quantiles in the weights");
  auto arguments = std::make_shared<CalibrateArguments>();
  calibrate->add_option("WEIGHTS", arguments->weights, "File of weights")->required();
  calibrate->add_option("--data", arguments->data, "Sets that were not trained on")->required();
  calibrate->add_option("--batches", arguments->batches, "Of 128 points")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  calibrate
      ->add_option("--nearest-wrong", arguments->nearest_wrong,
                   "Scale the descriptors so that this is the median distance of the nearest wrong "
                   "one; 0: leave them")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  calibrate->add_option("--output", arguments->output, "Another file (default: WEIGHTS)");
  calibrate->callback([arguments] { Calibrate(*arguments); });
}

}  // namespace lift_slam::training
