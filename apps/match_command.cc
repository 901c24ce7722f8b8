#include "apps/match_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/pair_features.h"
#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/features/image_pair.h"
#include "lift_slam/image/gamma.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/match_picture.h"

namespace lift_slam {
namespace {

struct MatchArguments {
  std::filesystem::path a, b, output, json, camera;
  std::string camera_name;
  PairFeatures features;
  std::string precision{nn::Name(LiftExtractorOptions().precision)};
  ImagePairOptions pair;
  int best = 100;
  double gamma = 1.0;
};

// What was matched, for all the outputs.
struct MatchedPair {
  std::string title;  // of the features
  GrayImage image_a, image_b;
  FeatureSet a, b;
  ImagePairResult result;
  std::span<const ImagePairMatch> best;  // of the result

  auto NumBestInliers() const { return std::ranges::count_if(best, &ImagePairMatch::is_inlier); }
};

void CheckRanges(const MatchArguments& arguments) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(what);
  };
  require(arguments.gamma >= 0.01 && arguments.gamma <= 100, "--gamma must be from 0.01 to 100");
  require(arguments.best >= 1, "--best must be at least 1");
  require(arguments.pair.max_ratio > 0 && arguments.pair.max_ratio <= 1,
          "--ratio must be above 0 and at most 1");
  require(arguments.pair.max_error_px > 0 && arguments.pair.max_error_px <= 100,
          "--max-error-px must be above 0 and at most 100");
  require(arguments.output.extension() == ".png", "--output must end in .png");
}

std::optional<Camera> ReadCamera(const MatchArguments& arguments, const GrayImage& image_a,
                                 const GrayImage& image_b) {
  if (arguments.camera.empty()) return std::nullopt;
  Camera camera = ReadCameraFile(arguments.camera, arguments.camera_name);
  PinholeIntrinsics& pinhole = camera.pinhole;
  if (pinhole.width == 0) {
    pinhole.width = image_a.width();
    pinhole.height = image_a.height();
  }
  for (const GrayImage* image : {&image_a, &image_b}) {
    if (image->width() != pinhole.width || image->height() != pinhole.height) {
      throw InputError(fmt::format("{} is for images of {} x {} pixels, not {} x {}",
                                   arguments.camera.string(), pinhole.width, pinhole.height,
                                   image->width(), image->height()));
    }
  }
  camera.Check();
  return camera;
}

MatchedPair MatchPair(const MatchArguments& arguments) {
  MatchedPair pair;
  pair.image_a = ReadImageOrThrow(arguments.a);
  pair.image_b = ApplyGamma(ReadImageOrThrow(arguments.b), arguments.gamma);
  const std::optional<Camera> camera = ReadCamera(arguments, pair.image_a, pair.image_b);
  NamedExtractor named = MakeExtractor(arguments.features);
  pair.title = named.title;
  pair.a = ExtractNamed(*named.extractor, pair.image_a, arguments.a);
  pair.b = ExtractNamed(*named.extractor, pair.image_b, arguments.b);
  pair.result = MatchImagePair(pair.a, pair.b, camera ? &*camera : nullptr, arguments.pair);
  const std::vector<ImagePairMatch>& matches = pair.result.matches;
  pair.best =
      std::span(matches).first(std::min(matches.size(), static_cast<std::size_t>(arguments.best)));
  return pair;
}

std::string_view ModelName(const MatchedPair& pair) {
  return kEpipolarModelNames[static_cast<std::size_t>(pair.result.model)];
}

std::vector<std::string> Captions(const MatchArguments& arguments, const MatchedPair& pair) {
  std::string images = fmt::format("{}: {} ({} features), {} ({} features", pair.title,
                                   arguments.a.filename().string(), pair.a.keypoints.size(),
                                   arguments.b.filename().string(), pair.b.keypoints.size());
  if (arguments.gamma != 1.0) images += fmt::format(", gamma {:g}", arguments.gamma);
  return {images + ")",
          fmt::format("best {} of {} matches: {} inliers (green), {} outliers (orange); of all: {} "
                      "inliers",
                      pair.best.size(), pair.result.matches.size(), pair.NumBestInliers(),
                      static_cast<std::ptrdiff_t>(pair.best.size()) - pair.NumBestInliers(),
                      pair.result.num_inliers)};
}

void WriteJson(const MatchArguments& arguments, const MatchedPair& pair) {
  nlohmann::ordered_json best = nlohmann::ordered_json::array();
  for (const ImagePairMatch& match : pair.best) {
    const Keypoint& a = pair.a.keypoints[static_cast<std::size_t>(match.a)];
    const Keypoint& b = pair.b.keypoints[static_cast<std::size_t>(match.b)];
    best.push_back({{"x_a", a.x},
                    {"y_a", a.y},
                    {"x_b", b.x},
                    {"y_b", b.y},
                    {"distance", match.distance},
                    {"inlier", match.is_inlier}});
  }
  const nlohmann::ordered_json contents = {{"a", arguments.a.string()},
                                           {"b", arguments.b.string()},
                                           {"features", pair.title},
                                           {"descriptors", pair.a.descriptors.kind().name},
                                           {"gamma", arguments.gamma},
                                           {"features_a", pair.a.keypoints.size()},
                                           {"features_b", pair.b.keypoints.size()},
                                           {"max_ratio", arguments.pair.max_ratio},
                                           {"max_error_px", arguments.pair.max_error_px},
                                           {"model", ModelName(pair)},
                                           {"matches", pair.result.matches.size()},
                                           {"inliers", pair.result.num_inliers},
                                           {"best_matches", pair.best.size()},
                                           {"best_inliers", pair.NumBestInliers()},
                                           {"best", best}};
  WriteTextAtomically(arguments.json, contents.dump(1) + "\n");
}

void Match(MatchArguments arguments) {
  CheckRanges(arguments);
  arguments.features.lift.precision = nn::ParsePrecision(arguments.precision);
  const MatchedPair pair = MatchPair(arguments);
  WriteTextAtomically(arguments.output, MatchPicture(pair.image_a, pair.image_b, pair.a, pair.b,
                                                     pair.best, Captions(arguments, pair)));
  if (!arguments.json.empty()) WriteJson(arguments, pair);
  std::cout << fmt::format(
      "{}: {} and {} features, {} matches, {} inliers ({} matrix); of the best {}: {} inliers\n",
      pair.title, pair.a.keypoints.size(), pair.b.keypoints.size(), pair.result.matches.size(),
      pair.result.num_inliers, ModelName(pair), pair.best.size(), pair.NumBestInliers());
}

void AddPairOptions(CLI::App& command, MatchArguments& arguments) {
  command.add_option("A", arguments.a, "First image")->required();
  command.add_option("B", arguments.b, "Second image")->required();
  command.add_option("--gamma", arguments.gamma, "B is made 255 (v / 255)^GAMMA before")
      ->capture_default_str();
  command.add_option("--best", arguments.best, "Matches drawn: those with the least distance")
      ->capture_default_str();
  command
      .add_option("--ratio", arguments.pair.max_ratio,
                  "Largest ratio of best and second-best distance; 1: not asked")
      ->capture_default_str();
  command
      .add_option("--max-error-px", arguments.pair.max_error_px,
                  "Distance from the epipolar geometry of an inlier")
      ->capture_default_str();
  command.add_option("--camera", arguments.camera,
                     "Calibration of both images: inliers by the essential matrix (without: by "
                     "the fundamental matrix)");
  command.add_option("--camera-name", arguments.camera_name, "Which camera of a rig");
}

void AddFeatureOptions(CLI::App& command, MatchArguments& arguments) {
  LiftExtractorOptions& lift = arguments.features.lift;
  command.add_option("--features", arguments.features.name, "lift, orb or sift")
      ->capture_default_str();
  command.add_option("--weights", arguments.features.weights,
                     "LIFT weights (.safetensors; default: those that ship)");
  command.add_flag("--upright,!--turned", lift.upright,
                   "LIFT's patches are not turned (default), or turned by the orientation network");
  command.add_option("--max-features", lift.max_features, "Features an image")
      ->capture_default_str();
  command.add_option("--precision", arguments.precision, "Arithmetic of LIFT's networks")
      ->check(CLI::IsMember({"auto", "float32", "bfloat16", "int8"}))
      ->capture_default_str();
  command.add_option("--threads", lift.num_threads, "Threads")->capture_default_str();
}

}  // namespace

void AddMatchCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "match", "Match two images and tell inliers from outliers, as a picture and as counts");
  auto arguments = std::make_shared<MatchArguments>();
  arguments->features.lift.num_threads = 2;
  AddPairOptions(*command, *arguments);
  AddFeatureOptions(*command, *arguments);
  command->add_option("--output", arguments->output, "Picture to write (.png)")->required();
  command->add_option("--json", arguments->json, "Counts and the best matches, to write");
  command->callback([arguments] { Match(*arguments); });
}

}  // namespace lift_slam
