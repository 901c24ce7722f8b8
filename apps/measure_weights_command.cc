#include "apps/measure_weights_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "apps/pair_features.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/measurement/weights_measurement.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

struct MeasureArguments {
  std::filesystem::path weights, output;
  std::vector<std::filesystem::path> images;
  std::vector<std::filesystem::path> pairs;  // two after two
  int num_patches = 200;
  DistanceMeasurement distances;
};

GrayImage ReadLargeEnough(const std::filesystem::path& path) {
  GrayImage image = ReadImageOrThrow(path);
  if (std::min(image.width(), image.height()) < kLiftPatchSize) {
    throw InputError(fmt::format("image '{}' has {} x {} pixels; LIFT needs at least {} x {}",
                                 path.string(), image.width(), image.height(), kLiftPatchSize,
                                 kLiftPatchSize));
  }
  return image;
}

std::vector<GrayImage> ReadImages(const std::vector<std::filesystem::path>& paths) {
  std::vector<GrayImage> images;
  for (const std::filesystem::path& path : paths) images.push_back(ReadLargeEnough(path));
  return images;
}

void Save(LiftWeights& weights, const std::filesystem::path& output) {
  WriteLiftWeights(weights, output);
  std::cout << fmt::format("{}: {}, SHA-256 {}\n", output.string(), weights.name, weights.sha256);
}

void Calibrate(const MeasureArguments& arguments) {
  if (arguments.num_patches < 1) throw InputError("--patches must be at least 1");
  LiftWeights weights = ReadLiftWeights(arguments.weights);
  weights.descriptor_ranges = MeasureRangesOnImages(
      weights, ReadImages(arguments.images), arguments.num_patches, arguments.distances.seed);
  std::cout << fmt::format("ranges: {}\n", fmt::join(weights.descriptor_ranges, " "));
  Save(weights, arguments.output);
}

void MeasureDistancesOf(const MeasureArguments& arguments) {
  if (arguments.distances.warps_per_image < 1) throw InputError("--warps must be at least 1");
  if (arguments.images.empty() && arguments.pairs.empty()) {
    throw InputError("weights distances needs images, or --pair A B");
  }
  LiftWeights weights = ReadLiftWeights(arguments.weights);
  std::vector<std::pair<GrayImage, GrayImage>> pairs;
  for (std::size_t i = 0; i + 1 < arguments.pairs.size(); i += 2) {
    pairs.emplace_back(ReadLargeEnough(arguments.pairs[i]),
                       ReadLargeEnough(arguments.pairs[i + 1]));
  }
  const MeasuredDistances measured =
      MeasureDistances(weights, ReadImages(arguments.images), pairs, arguments.distances);
  weights.distances = measured.quantiles;
  std::cout << fmt::format(
      "{} pairs of keypoints; 5, 25, 50, 75, 95 % of distances\n"
      "matching       {:.3f}\nnearest wrong  {:.3f}\n",
      measured.num_pairs, fmt::join(measured.quantiles.matching, " "),
      fmt::join(measured.quantiles.nearest_wrong, " "));
  Save(weights, arguments.output);
}

CLI::App* AddCommand(CLI::App& parent, const char* name, const char* description,
                     MeasureArguments& arguments) {
  CLI::App* command = parent.add_subcommand(name, description);
  command->add_option("--weights", arguments.weights, "LIFT weights (.safetensors)")->required();
  command
      ->add_option("--output", arguments.output, "File to write: the same with what was measured")
      ->required();
  command->add_option("--seed", arguments.distances.seed, "Of what is drawn at random")
      ->capture_default_str();
  return command;
}

void AddCalibrate(CLI::App& weights) {
  auto arguments = std::make_shared<MeasureArguments>();
  CLI::App* command = AddCommand(weights, "calibrate",
                                 "Measure the ranges that int8 needs on photographs", *arguments);
  command->add_option("IMAGES", arguments->images, "Photographs")->required();
  command->add_option("--patches", arguments->num_patches, "Patches in all, 0.1 s each")
      ->capture_default_str();
  command->callback([arguments] { Calibrate(*arguments); });
}

void AddDistances(CLI::App& weights) {
  auto arguments = std::make_shared<MeasureArguments>();
  DistanceMeasurement& distances = arguments->distances;
  distances.num_threads = 2;
  CLI::App* command =
      AddCommand(weights, "distances",
                 "Measure how near descriptors of one place and of others are", *arguments);
  command->add_option("IMAGES", arguments->images, "Photographs, matched with warped copies");
  command->add_option("--pair", arguments->pairs, "Two photographs of one scene; may be repeated")
      ->type_size(2)
      ->expected(-1);
  command->add_option("--warps", distances.warps_per_image, "Warped copies of each image")
      ->capture_default_str();
  command->add_flag("--upright,!--turned", distances.upright,
                    "Patches are not turned (default), or turned by the orientation network");
  command->callback([arguments] { MeasureDistancesOf(*arguments); });
}

}  // namespace

void AddMeasureWeightsCommands(CLI::App& weights) {
  AddCalibrate(weights);
  AddDistances(weights);
}

}  // namespace lift_slam
