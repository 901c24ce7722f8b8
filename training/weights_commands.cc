#include "training/weights_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/nn/half_float.h"
#include "lift_slam/util/input_error.h"
#include "training/distance_statistics.h"
#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/training_stage.h"

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
  weights.orientation = orientation.orientation;
  weights.orientation_input = orientation.orientation_input;
  weights.detector = detector.detector;
  weights.detector_input = detector.detector_input;
  weights.name = arguments.name;
  weights.provenance = "descriptor: " + weights.provenance +
                       "\norientation: " + orientation.provenance +
                       "\ndetector: " + detector.provenance;
  weights.distances.reset();
  RoundOrientation(weights);
  WriteLiftWeights(weights, arguments.output);
  std::cout << fmt::format("{}: SHA-256 {}\n", arguments.output.string(), weights.sha256);
}

// Distances between patches as the sets have them, without noise or changes of light; those of
// points with one view are slanted and relit a little, else they would be equal.
DistanceQuantiles MeasureDistances(LiftWeights& weights, const std::vector<WeightedSet>& sets,
                                   int batches) {
  const ViewOptions views{.max_tilt = 1.4,
                          .max_perspective = 0.01,
                          .position_noise_sigmas = 0.1,
                          .scale_noise_octaves = 0.05,
                          .rotation_noise_deg = 2.0,
                          .turned_share = 0.0};
  const PhotometryOptions light{.max_gamma = 1.1,
                                .gamma_share = 0.0,
                                .max_gain = 1.1,
                                .max_offset = 5.0,
                                .max_noise = 2.0,
                                .blurred_share = 0.0};
  constexpr std::uint64_t kSeed = 70001;
  const PatchSampler sampler(sets, {}, views, light, kSeed);
  DescriptorModule descriptor;
  LoadParameters(weights, "descriptor", descriptor);
  const torch::NoGradGuard no_gradients;
  DistanceStatistics statistics;
  for (int i = 0; i < batches; ++i) {
    const PatchBatch batch = sampler.Draw(static_cast<std::uint64_t>(i));
    const auto first = descriptor.forward(PatchTensor(batch.first, batch.count, batch.size));
    const auto second = descriptor.forward(PatchTensor(batch.second, batch.count, batch.size));
    statistics.Add(AllDistances(first, second), DifferenceTensor(batch));
  }
  return statistics.Quantiles();
}

// Makes all distances `factor` times as large: after the last convolution come only a ReLU and
// means, and one factor for all of them tells points apart as before.
void ScaleDescriptors(LiftWeights& weights, double factor) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with("descriptor.conv3.")) continue;
    for (float& value : parameter.values) value *= static_cast<float>(factor);
  }
  for (auto* quantiles : {&weights.distances->matching, &weights.distances->nearest_wrong}) {
    for (float& distance : *quantiles) distance *= static_cast<float>(factor);
  }
}

void Calibrate(const CalibrateArguments& arguments) {
  LiftWeights weights = ReadLiftWeights(arguments.weights);
  CheckInput(arguments.weights, weights.descriptor_input);
  if (weights.topology != LiftTopology::kF) {
    throw InputError(
        fmt::format("{}: only topology F can be measured here", arguments.weights.string()));
  }
  const auto sets = OpenTrainingSets(fmt::format("{}", fmt::join(arguments.data, " ")));
  weights.distances = MeasureDistances(weights, sets, arguments.batches);
  if (arguments.nearest_wrong > 0.0) {
    ScaleDescriptors(weights, arguments.nearest_wrong / weights.distances->nearest_wrong[2]);
  }
  constexpr int kRangePatches = 256;
  const PatchBatch batch = PatchSampler(sets, {.count = kRangePatches}, {}, {}, 1).Draw(0);
  weights.descriptor_ranges = MeasureDescriptorRanges(weights, batch.first);
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
