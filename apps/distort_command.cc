#include "apps/distort_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <set>

#include "apps/output_folder.h"
#include "apps/pair_features.h"
#include "lift_slam/image/image_distortion.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/contact_sheet.h"

namespace lift_slam {
namespace {

struct DistortArguments {
  std::vector<std::filesystem::path> images;
  std::string distort;
  std::filesystem::path output, figure;
  std::uint64_t seed = 0;
};

// The paper's conditions (Figure 7) and what it could not run, with their labels.
constexpr std::pair<const char*, const char*> kFigure[] = {
    {"gamma=1", "original"},
    {"gamma=0.25", "gamma 0.25 (overexposed)"},
    {"gamma=0.5", "gamma 0.5"},
    {"gamma=2", "gamma 2"},
    {"gamma=4", "gamma 4 (underexposed)"},
    {"q1", "truncation in Q1"},
    {"q3", "truncation in Q3"},
    {"salt-pepper=0.02", "salt and pepper, 2 %"},
    {"salt-pepper=0.05", "salt and pepper, 5 %"},
};
constexpr int kFigureColumns = 3;

void CheckArguments(const DistortArguments& arguments) {
  if (arguments.output.empty() && arguments.figure.empty()) {
    throw InputError("distort needs --output FOLDER with --distort SPEC, or --figure FILE.png");
  }
  if (arguments.output.empty() != arguments.distort.empty()) {
    throw InputError("--output FOLDER and --distort SPEC go together");
  }
  if (!arguments.figure.empty() && arguments.figure.extension() != ".png") {
    throw InputError(fmt::format("--figure '{}' must end in .png", arguments.figure.string()));
  }
  std::set<std::string> names;
  for (const std::filesystem::path& image : arguments.images) {
    if (!names.insert(image.stem().string()).second) {
      throw InputError(fmt::format("two images are called '{}', and so would the results be",
                                   image.stem().string()));
    }
  }
}

void WriteImages(const DistortArguments& arguments) {
  const std::vector<ImageDistortion> chain = ParseImageDistortions(arguments.distort);
  PrepareOutputFolder(arguments.output);
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    const std::filesystem::path& path = arguments.images[i];
    const GrayImage image =
        Distort(ReadImageOrThrow(path), chain, arguments.seed, static_cast<std::int64_t>(i));
    WriteTextAtomically(arguments.output / (path.stem().string() + ".png"), EncodePng(image));
  }
  std::cout << fmt::format("{} images with {} in {}\n", arguments.images.size(), ToText(chain),
                           arguments.output.string());
}

void WriteFigure(const DistortArguments& arguments) {
  const GrayImage image = ReadImageOrThrow(arguments.images.front());
  std::vector<LabelledImage> cells;
  for (const auto& [spec, label] : kFigure) {
    cells.push_back({label, Distort(image, ParseImageDistortions(spec), arguments.seed, 0)});
  }
  WriteTextAtomically(arguments.figure, ContactSheet(cells, kFigureColumns));
  std::cout << fmt::format("figure      {}\n", arguments.figure.string());
}

void RunDistort(const DistortArguments& arguments) {
  CheckArguments(arguments);
  if (!arguments.output.empty()) WriteImages(arguments);
  if (!arguments.figure.empty()) WriteFigure(arguments);
}

}  // namespace

void AddDistortCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "distort", "Images under bad exposure, noise or blur, as 'run --distort' sees them");
  const auto arguments = std::make_shared<DistortArguments>();
  command->add_option("IMAGES", arguments->images, "Image files; their order numbers the frames")
      ->required();
  command->add_option("--distort", arguments->distort, "What to do, see below")->type_name("SPEC");
  command->add_option("--output", arguments->output, "Folder for the images (.png)");
  command->add_option("--figure", arguments->figure,
                      "Picture of the first image under all of the paper's conditions (.png)");
  command->add_option("--seed", arguments->seed, "Of what is random (default 0)");
  command->footer(
      "SPEC is one of these, or several with commas, in order:\n"
      "  gamma=G           255 (I / 255)^G: below 1 brighter, above 1 darker\n"
      "  q1, q3            values up to the 25th percentile to 0; from the 75th to 255\n"
      "  q1-clip, q3-clip  values beyond the percentile to the percentile\n"
      "  salt-pepper=P     a share P of the pixels to 0 or 255\n"
      "  noise=SIGMA       normal noise, grey levels\n"
      "  blur=SIGMA        Gaussian blur, pixels\n"
      "Examples:\n"
      "  lift_slam distort image_0/000000.png --distort gamma=4 --output dark\n"
      "  lift_slam distort image_0/000000.png --figure conditions.png");
  command->callback([arguments] { RunDistort(*arguments); });
}

}  // namespace lift_slam
