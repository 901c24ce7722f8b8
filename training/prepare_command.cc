#include "training/prepare_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "lift_slam/util/config_file.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/option_writer.h"
#include "training/colmap_import.h"
#include "training/colmap_run.h"
#include "training/folder_name.h"
#include "training/photograph_import.h"
#include "training/rendered_import.h"

namespace lift_slam::training {
namespace {

struct PrepareArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::vector<std::string> overrides;
  std::string licence = "unknown", author = "unknown";
  std::filesystem::path images, database, work;
  std::string sequence;
};

// Options of `prepare sequence`: the reconstruction, then what becomes of it.
struct SequenceOptionsOfSet {
  ReconstructionOptions reconstruction;
  ColmapOptions set;
  void Visit(OptionVisitor& visitor) {
    visitor.Group("reconstruction", reconstruction, "COLMAP");
    visitor.Group("set", set, "the training set");
  }
  void Check() const {
    reconstruction.Check();
    set.Check();
  }
};

ImportProgress ShowProgress(const std::string& name) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  return [=](int done, int total, std::size_t points) {
    if (!terminal && done != total) return;
    std::cerr << fmt::format("{}{}: {} of {} images, {} points{}", terminal ? "\r" : "", name, done,
                             total, points, done == total ? "\n" : "");
  };
}

void AddCommon(CLI::App& command, PrepareArguments& arguments) {
  command.add_option("--output", arguments.output, "Folder of the training set")->required();
  command.add_option("--set", arguments.overrides, "One option, KEY=VALUE; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

template <class Options>
std::string Configure(const PrepareArguments& arguments, Options& options) {
  ConfigureOptions({}, arguments.overrides, MakeOptionRoot(options));
  options.Check();
  return OptionsToYaml(MakeOptionRoot(options));
}

void Report(const PrepareArguments& arguments, const TrainingSetWriter& writer) {
  std::cout << fmt::format("{}: {} images, {} points\n", arguments.output.string(),
                           writer.num_images(), writer.num_points());
}

void PreparePhotographs(const PrepareArguments& arguments) {
  PhotographOptions options;
  const std::string settings = Configure(arguments, options);
  TrainingSetWriter writer(arguments.output);
  for (const std::filesystem::path& input : arguments.inputs) {
    ImportPhotographs(input, options, ShowProgress(input.string()), writer);
  }
  writer.Finish("prepare photographs\n" + settings);
  Report(arguments, writer);
}

void PrepareRendered(const PrepareArguments& arguments) {
  RenderedOptions options;
  const std::string settings = Configure(arguments, options);
  TrainingSetWriter writer(arguments.output);
  for (const std::filesystem::path& input : arguments.inputs) {
    const std::string name = FolderName(input);
    // Stretches of one track, NAME-START, show the same places.
    const std::string scene = name.substr(0, name.find_last_of('-'));
    const ImageOrigin origin{.name = name,
                             .scene = scene.empty() ? name : scene,
                             .source = "rendered " + scene,
                             .licence = arguments.licence,
                             .author = arguments.author};
    ImportRendered(input, origin, options, ShowProgress(input.string()), writer);
  }
  writer.Finish("prepare rendered\n" + settings);
  Report(arguments, writer);
}

ImageOrigin OriginOf(const PrepareArguments& arguments, const std::string& source) {
  return {.source = source, .licence = arguments.licence, .author = arguments.author};
}

void PrepareColmap(const PrepareArguments& arguments) {
  ColmapOptions options;
  const std::string settings = Configure(arguments, options);
  const ColmapPaths paths{arguments.inputs.front(), arguments.images, arguments.database};
  TrainingSetWriter writer(arguments.output);
  ImportColmap(paths, OriginOf(arguments, paths.model.string()), options,
               ShowProgress(paths.model.string()), writer);
  writer.Finish("prepare colmap\n" + settings);
  Report(arguments, writer);
}

void PrepareSequence(const PrepareArguments& arguments) {
  SequenceOptionsOfSet options;
  const std::string settings = Configure(arguments, options);
  const std::filesystem::path work =
      arguments.work.empty() ? arguments.output / "reconstruction" : arguments.work;
  std::cerr << fmt::format("Reconstructing {} by COLMAP; {} tells more\n", arguments.sequence,
                           (work / "colmap.log").string());
  const ColmapPaths paths = ReconstructSequence(arguments.sequence, work, options.reconstruction);
  TrainingSetWriter writer(arguments.output);
  ImportColmap(paths, OriginOf(arguments, arguments.sequence), options.set,
               ShowProgress(arguments.sequence), writer);
  writer.Finish("prepare sequence\n" + settings);
  Report(arguments, writer);
}

void AddColmap(CLI::App& prepare, const std::shared_ptr<PrepareArguments>& arguments) {
  CLI::App* colmap = prepare.add_subcommand("colmap", "From a reconstruction by COLMAP");
  colmap->add_option("MODEL", arguments->inputs, "Folder with images.bin or images.txt")
      ->required()
      ->expected(1);
  colmap->add_option("--images", arguments->images, "Folder that the images' names start from")
      ->required();
  colmap->add_option("--database", arguments->database, "COLMAP's database.db");
  AddCommon(*colmap, *arguments);
  colmap->callback([arguments] { PrepareColmap(*arguments); });

  CLI::App* sequence = prepare.add_subcommand(
      "sequence", "From any sequence lift_slam runs on: reconstructs it by COLMAP first (hours)");
  sequence->add_option("SEQUENCE", arguments->sequence, "Folder or video")->required();
  sequence->add_option("--work", arguments->work,
                       "Folder of the reconstruction (default OUTPUT/reconstruction)");
  AddCommon(*sequence, *arguments);
  sequence->callback([arguments] { PrepareSequence(*arguments); });
}

}  // namespace

void AddPrepareCommand(CLI::App& app) {
  CLI::App* prepare = app.add_subcommand("prepare", "Make a training set");
  prepare->require_subcommand(1);
  auto arguments = std::make_shared<PrepareArguments>();

  CLI::App* photographs = prepare->add_subcommand(
      "photographs", "From folders of photographs: pairs by random slants, turns and light");
  photographs->add_option("FOLDERS", arguments->inputs, "With manifest.tsv, or any images")
      ->required();
  AddCommon(*photographs, *arguments);
  photographs->callback([arguments] { PreparePhotographs(*arguments); });

  CLI::App* rendered = prepare->add_subcommand(
      "rendered", "From sequences of 'lift_slam render --depth --pairs': pairs by exact geometry");
  rendered->add_option("FOLDERS", arguments->inputs, "Output folders of lift_slam render")
      ->required();
  rendered->add_option("--licence", arguments->licence, "Of the scenes")->capture_default_str();
  rendered->add_option("--author", arguments->author, "Of the scenes")->capture_default_str();
  AddCommon(*rendered, *arguments);
  rendered->callback([arguments] { PrepareRendered(*arguments); });
  AddColmap(*prepare, arguments);
}

}  // namespace lift_slam::training
