#include "apps/extract_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "apps/npz_file.h"
#include "apps/output_folder.h"
#include "apps/pair_features.h"
#include "apps/patch_extraction.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/keypoint_picture.h"

namespace lift_slam {
namespace {

struct ExtractArguments {
  std::vector<std::filesystem::path> images;
  std::filesystem::path weights, output;
  std::string precision{nn::Name(LiftExtractorOptions().precision)};
  LiftExtractorOptions options;
  PatchExtraction patches;  // instead of images
};

// Files of one image are named after it: two of the same name would overwrite each other.
void CheckNames(const std::vector<std::filesystem::path>& images) {
  std::set<std::string> names;
  for (const std::filesystem::path& image : images) {
    if (!names.insert(image.stem().string()).second) {
      throw InputError(fmt::format("two images are called '{}', and so would their features be",
                                   image.stem().string()));
    }
  }
}

void WriteFeatures(const FeatureSet& features, const ScaleLevels& levels,
                   const std::filesystem::path& path) {
  std::vector<float> positions, sigmas, angles, responses;
  std::vector<std::int32_t> level_indices;
  for (const Keypoint& k : features.keypoints) {
    positions.insert(positions.end(), {k.x, k.y});
    sigmas.push_back(static_cast<float>(levels.Scale(k.level)));
    angles.push_back(k.angle_rad);
    responses.push_back(k.response);
    level_indices.push_back(k.level);
  }
  const std::size_t count = features.keypoints.size();
  const auto dimension = static_cast<std::size_t>(features.descriptors.kind().dimension);
  NpzFile file;
  file.Add("positions", {count, 2}, positions);
  file.Add("sigmas", {count}, sigmas);
  file.Add("angles_rad", {count}, angles);
  file.Add("responses", {count}, responses);
  file.Add("levels", {count}, level_indices);
  file.Add(
      "descriptors", {count, dimension},
      std::span(reinterpret_cast<const float*>(features.descriptors.data()), count * dimension));
  file.Write(path);
}

void ExtractImage(const std::filesystem::path& path, const std::filesystem::path& output,
                  FeatureExtractor& extractor) {
  const GrayImage image = ReadImageOrThrow(path);
  const auto start = std::chrono::steady_clock::now();
  const FeatureSet features = ExtractNamed(extractor, image, path);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const std::string name = path.stem().string();
  WriteFeatures(features, extractor.scale_levels(), output / (name + ".npz"));
  WriteTextAtomically(output / (name + ".png"),
                      KeypointPicture(image, features, extractor.scale_levels()));
  std::cout << fmt::format("{}: {} features in {:.3f} s\n", path.string(),
                           features.keypoints.size(), seconds.count());
}

void ExtractImages(const ExtractArguments& arguments) {
  CheckNames(arguments.images);
  const LiftWeights weights = ReadLiftWeightsOrDefault(arguments.weights);
  if (!weights.orientation && !arguments.options.upright) {
    throw InputError(fmt::format("the weights '{}' have no orientation network; leave --turned out",
                                 weights.name));
  }
  LiftExtractor extractor(weights, arguments.options);
  if (!extractor.precision().reason.empty()) {
    std::cout << fmt::format("descriptors in {}: {}\n", nn::Name(extractor.precision().used),
                             extractor.precision().reason);
  }
  PrepareOutputFolder(arguments.output);
  for (const std::filesystem::path& image : arguments.images) {
    ExtractImage(image, arguments.output, extractor);
  }
}

void Extract(ExtractArguments arguments) {
  PatchExtraction& patches = arguments.patches;
  if (arguments.images.empty() == patches.patches.empty()) {
    throw InputError("extract needs either IMAGES or --patches FILE");
  }
  if (patches.patches.empty() && (patches.orientation || !patches.shape.empty())) {
    throw InputError("--shape and --orientation go with --patches");
  }
  arguments.options.precision = nn::ParsePrecision(arguments.precision);
  if (patches.patches.empty()) {
    ExtractImages(arguments);
    return;
  }
  patches.weights = arguments.weights;
  patches.output = arguments.output;
  patches.precision = arguments.options.precision;
  patches.num_threads = arguments.options.num_threads;
  ExtractPatches(patches);
}

void AddPatchOptions(CLI::App& command, PatchExtraction& patches) {
  command.add_option("--patches", patches.patches,
                     "Instead of images: 64 x 64 uint8 patches, one after the other; --output is "
                     "then the .npy file of their descriptors (float32, N x 128)");
  command.add_option("--shape", patches.shape, "Of the patches: N,64,64 (default: all there are)");
  command.add_flag("--orientation", patches.orientation,
                   "Also the patches' angles (float32 radians), into NAME_angles.npy");
}

}  // namespace

void AddExtractCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("extract", "LIFT features of images, or descriptors of patches, as files");
  auto arguments = std::make_shared<ExtractArguments>();
  LiftExtractorOptions& options = arguments->options;
  options.num_threads = 2;
  command->add_option("IMAGES", arguments->images, "Images");
  command->add_option("--weights", arguments->weights,
                      "LIFT weights (.safetensors; default: those that ship)");
  command
      ->add_option("--output", arguments->output,
                   "Folder for NAME.npz (positions, sigmas, angles_rad, responses, levels, "
                   "descriptors) and NAME.png (picture with keypoints) of each image")
      ->required();
  command->add_option("--max-features", options.max_features, "Features an image; 0: all found")
      ->capture_default_str();
  command->add_flag("--upright,!--turned", options.upright,
                    "Patches are not turned (default), or turned by the orientation network");
  command
      ->add_option("--first-level", options.detector.first_level,
                   "First level searched; 5 leaves the up-sampled octave out")
      ->capture_default_str();
  command->add_option("--precision", arguments->precision, "Arithmetic of the networks")
      ->check(CLI::IsMember({"auto", "float32", "bfloat16", "int8"}))
      ->capture_default_str();
  command->add_option("--threads", options.num_threads, "Threads")->capture_default_str();
  AddPatchOptions(*command, arguments->patches);
  command->callback([arguments] { Extract(*arguments); });
}

}  // namespace lift_slam
