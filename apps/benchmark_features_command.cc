#include "apps/benchmark_features_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "benchmarks/features/homography_table.h"
#include "benchmarks/features/orientation_table.h"
#include "benchmarks/features/quality_tables.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> weights;  // none: those that ship
  std::filesystem::path data, patches, output;
  std::vector<std::string> precisions{"auto"};
  std::vector<std::string> tables{"descriptors", "matching", "repeatability", "orientation",
                                  "homography"};
  std::vector<std::vector<std::filesystem::path>> extra;  // two images each
  int num_pairs = 8;
  QualityOptions quality;

  bool Wants(const char* table) const { return std::ranges::find(tables, table) != tables.end(); }
};

// Tables as they are finished: shown, and kept for the file.
class Tables {
 public:
  void Add(const std::string& title, const std::string& table) {
    const std::string text = fmt::format("\n{}\n\n{}", title, table);
    std::cout << text << std::flush;
    text_ += text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::vector<NamedWeights> ReadAll(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return {{"LIFT", ReadLiftWeightsOrDefault("")}};
  std::vector<NamedWeights> all;
  for (const auto& file : files) all.push_back({file.stem().string(), ReadLiftWeights(file)});
  return all;
}

// Matches within so many pixels of where a known homography takes them, a curve a feature.
void WriteAccuracyPlot(const std::vector<AccuracyCurve>& curves,
                       const std::filesystem::path& file) {
  Plot plot;
  plot.description = "Mean matching accuracy by pixel threshold";
  plot.x.label = "error of a match at most [px]";
  plot.x.min = 0.0;
  plot.y.label = "share of the matches [%]";
  plot.y.min = 0.0;
  plot.y.max = 100.0;
  for (const AccuracyCurve& curve : curves) {
    PlotSeries series;
    series.label = curve.name;
    series.color = static_cast<PlotColor>(1 + plot.series.size() % (kNumPlotColors - 2));
    series.x = curve.thresholds_px;
    series.y = curve.percent;
    plot.series.push_back(series);
  }
  WriteTextAtomically(file, RenderSvgFile(plot));
}

void AddPrecision(const Arguments& arguments, std::span<const NamedWeights> all, Tables& tables) {
  const std::string bytes = ReadText(arguments.patches);
  if (bytes.empty() || bytes.size() % (64 * 64) != 0) {
    throw InputError(fmt::format("{}: {} bytes are no whole number of 64 x 64 patches",
                                 arguments.patches.string(), bytes.size()));
  }
  const std::vector<std::uint8_t> patches(bytes.begin(), bytes.end());
  tables.Add("Precision on given patches", PrecisionTable(all, patches, arguments.quality));
}

void AddTables(const Arguments& arguments, std::span<const NamedWeights> all, Tables& tables,
               std::vector<AccuracyCurve>& curves) {
  const QualityOptions& quality = arguments.quality;
  if (!arguments.patches.empty()) AddPrecision(arguments, all, tables);
  std::vector<ImageSet> sets = RealImageSets(arguments.data, arguments.num_pairs);
  const std::vector<ImageSet> ends = OneOfEachKind(sets);
  for (const auto& pair : arguments.extra) sets.push_back(SinglePair(pair[0], pair[1]));
  if (sets.empty() && arguments.patches.empty()) {
    throw InputError("no images: neither --data with sequences nor --pair A B");
  }
  if (arguments.Wants("descriptors")) {
    tables.Add("Descriptors on SIFT's keypoints", DescriptorTable(all, sets, quality));
  }
  if (arguments.Wants("matching")) tables.Add("Matching", MatchingTable(all, sets, quality));
  const std::vector<ImageSet>& known = ends.empty() ? sets : ends;
  if (arguments.Wants("repeatability")) {
    tables.Add("Repeatability", RepeatabilityTable(all, known, quality));
  }
  if (arguments.Wants("orientation")) {
    tables.Add("Orientation", OrientationTable(all, known, quality));
  }
  if (arguments.Wants("homography")) {
    tables.Add("Known homographies", HomographyTables(all, known, quality, curves));
  }
  if (!arguments.Wants("keypoints")) return;
  for (const NamedWeights& weights : all) {
    tables.Add("Choice of keypoints, " + weights.name,
               KeypointChoiceTable(weights, known, quality));
  }
}

void BenchmarkFeatures(Arguments arguments) {
  arguments.quality.precisions.clear();
  for (const std::string& name : arguments.precisions) {
    arguments.quality.precisions.push_back(nn::ParsePrecision(name));
  }
  Tables tables;
  std::vector<AccuracyCurve> curves;
  AddTables(arguments, ReadAll(arguments.weights), tables, curves);
  if (arguments.output.empty()) return;
  std::filesystem::create_directories(arguments.output);
  WriteTextAtomically(arguments.output / "features.md", tables.text());
  if (!curves.empty()) WriteAccuracyPlot(curves, arguments.output / "matching_accuracy.svg");
}

void AddOptions(CLI::App& command, Arguments& arguments) {
  command.add_option("--weights", arguments.weights,
                     "LIFT weights (.safetensors; default: those that ship)");
  command
      .add_option("--data", arguments.data,
                  "Folder with kitti/ and 7scenes_redkitchen/ (default: LIFT_SLAM_DATA)")
      ->capture_default_str();
  command.add_option("--pair", arguments.extra, "Two more images of one scene; may be repeated")
      ->type_size(2);
  command.add_option("--pairs", arguments.num_pairs, "Image pairs of each kind")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--tables", arguments.tables, "Which tables")
      ->check(CLI::IsMember(
          {"descriptors", "matching", "repeatability", "orientation", "homography", "keypoints"}));
  command.add_option("--precisions", arguments.precisions, "auto, float32, bfloat16, int8")
      ->check(CLI::IsMember({"auto", "float32", "bfloat16", "int8"}));
  command.add_option("--patches", arguments.patches,
                     "64 x 64 uint8 patches, for a table of the precisions' differences");
  command.add_option("--max-features", arguments.quality.max_features, "Features an image")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  command.add_option("--threads", arguments.quality.num_threads, "Threads")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_option("--output", arguments.output,
                     "Folder for features.md and matching_accuracy.svg");
}

}  // namespace

void AddBenchmarkFeaturesCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("benchmark-features",
                         "Compare LIFT weights, ORB and SIFT on real images: repeatability, "
                         "matching, FPR95, homographies");
  const auto arguments = std::make_shared<Arguments>();
  if (const char* data = std::getenv("LIFT_SLAM_DATA")) arguments->data = data;
  AddOptions(*command, *arguments);
  command->footer(
      "Examples:\n"
      "  lift_slam benchmark-features --data ~/data --output features\n"
      "  lift_slam benchmark-features --pair a.png b.png --weights mine.safetensors");
  command->callback([arguments] { BenchmarkFeatures(*arguments); });
}

}  // namespace lift_slam
