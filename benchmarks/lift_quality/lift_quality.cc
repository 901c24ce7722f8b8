// What LIFT weights are worth on real images, as Markdown tables (docs/lift.md):
//   lift_quality --weights A.safetensors B.safetensors --data FOLDER --patches patches.raw
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/lift_quality/homography_table.h"
#include "benchmarks/lift_quality/orientation_table.h"
#include "benchmarks/lift_quality/quality_tables.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> weights;
  std::filesystem::path data, patches;
  std::vector<std::string> precisions{"float32"};
  std::vector<std::string> tables{"precision",   "descriptors", "matching", "repeatability",
                                  "orientation", "homography",  "keypoints"};
  std::vector<std::vector<std::filesystem::path>> extra;  // two images each
  int num_pairs = 20;
  QualityOptions quality;

  bool Wants(const char* table) const { return std::ranges::find(tables, table) != tables.end(); }
};

void Print(const char* title, const std::string& table) {
  fmt::print("\n{}\n\n{}", title, table);
  std::fflush(stdout);
}

std::vector<NamedWeights> ReadAll(const std::vector<std::filesystem::path>& files) {
  std::vector<NamedWeights> all;
  for (const auto& file : files) all.push_back({file.stem().string(), ReadLiftWeights(file)});
  return all;
}

void PrintPrecision(const Arguments& arguments, std::span<const NamedWeights> all) {
  const std::string bytes = ReadText(arguments.patches);
  if (bytes.empty() || bytes.size() % (64 * 64) != 0) {
    throw InputError(fmt::format("{}: {} bytes are no whole number of 64 x 64 patches",
                                 arguments.patches.string(), bytes.size()));
  }
  const std::vector<std::uint8_t> patches(bytes.begin(), bytes.end());
  Print("Precision on given patches", PrecisionTable(all, patches, arguments.quality));
}

// One set of each kind of images.
std::vector<ImageSet> Ends(const std::vector<ImageSet>& sets) {
  if (sets.size() < 2) return sets;
  return {sets.front(), sets.back()};
}

void Run(Arguments arguments) {
  arguments.quality.precisions.clear();
  for (const std::string& name : arguments.precisions) {
    arguments.quality.precisions.push_back(nn::ParsePrecision(name));
  }
  const std::vector<NamedWeights> all = ReadAll(arguments.weights);
  if (arguments.Wants("precision") && !arguments.patches.empty()) PrintPrecision(arguments, all);
  std::vector<ImageSet> sets = RealImageSets(arguments.data, arguments.num_pairs);
  const std::vector<ImageSet> ends = Ends(sets);
  for (const auto& pair : arguments.extra) sets.push_back(SinglePair(pair[0], pair[1]));
  if (arguments.Wants("descriptors")) {
    Print("Descriptors on SIFT's keypoints", DescriptorTable(all, sets, arguments.quality));
  }
  if (arguments.Wants("matching")) {
    Print("Matching", MatchingTable(all, sets, arguments.quality));
  }
  if (ends.empty()) return;
  if (arguments.Wants("repeatability")) {
    Print("Repeatability", RepeatabilityTable(all, ends));
  }
  if (arguments.Wants("orientation")) {
    Print("Orientation", OrientationTable(all, ends));
  }
  if (arguments.Wants("homography")) {
    Print("Known homographies", HomographyTables(all, ends, arguments.quality));
  }
  if (arguments.Wants("keypoints") && ends.size() > 1) {
    const ImageSet few[] = {sets[0], sets[1], ends.back()};
    for (const NamedWeights& weights : all) {
      Print(("Choice of keypoints, " + weights.name).c_str(),
            KeypointChoiceTable(weights, few, arguments.quality));
    }
  }
}

int Main(int argc, char** argv) {
  CLI::App app("Quality of LIFT weights on real images, as Markdown tables");
  Arguments arguments;
  if (const char* data = std::getenv("LIFT_SLAM_DATA")) arguments.data = data;
  app.add_option("--weights", arguments.weights, "LIFT weights (.safetensors)")->required();
  app.add_option("--data", arguments.data, "Folder with kitti/ and 7scenes_redkitchen/")
      ->capture_default_str();
  app.add_option("--patches", arguments.patches, "64 x 64 uint8 patches, for the precision table");
  app.add_option("--precisions", arguments.precisions, "float32, bfloat16, int8")
      ->check(CLI::IsMember({"float32", "bfloat16", "int8"}));
  app.add_option("--tables", arguments.tables, "Which tables")
      ->check(CLI::IsMember({"precision", "descriptors", "matching", "repeatability", "orientation",
                             "homography", "keypoints"}));
  app.add_option("--pair", arguments.extra, "Two more images of one scene; may be repeated")
      ->type_size(2);
  app.add_option("--pairs", arguments.num_pairs, "Image pairs of each kind")
      ->check(CLI::Range(1, 100));
  app.add_option("--max-features", arguments.quality.max_features, "Features an image");
  app.add_option("--threads", arguments.quality.num_threads, "Threads");
  CLI11_PARSE(app, argc, argv);
  try {
    Run(arguments);
    return 0;
  } catch (const InputError& error) {
    fmt::print(stderr, "lift_quality: {}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace lift_slam

int main(int argc, char** argv) { return lift_slam::Main(argc, argv); }
