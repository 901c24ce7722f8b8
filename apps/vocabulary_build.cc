#include "apps/vocabulary_build.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/exit_code.h"
#include "apps/progress_bar.h"
#include "apps/stop_signal.h"
#include "apps/vocabulary_images.h"
#include "lift_slam/image/image_threads.h"
#include "lift_slam/place_recognition/descriptor_file.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

fs::path WithSuffix(const fs::path& path, const char* suffix) { return path.string() + suffix; }

fs::path DescriptorsPath(const VocabularyBuildArguments& arguments) {
  return arguments.descriptors.empty() ? WithSuffix(arguments.output, ".descriptors")
                                       : arguments.descriptors;
}

// What determines the descriptors: going on with those of other images or options is refused.
std::string SourceSha256(const VocabularyBuildArguments& arguments,
                         const std::vector<fs::path>& images, const DescriptorKind& kind) {
  std::string text = fmt::format("{} {}\n", arguments.features.Key(kind), arguments.max_side_px);
  for (const fs::path& image : images) {
    text += fmt::format("{} {}\n", image.filename().string(), fs::file_size(image));
  }
  return Sha256Hex(text);
}

[[noreturn]] void EndStopped(const StopSignal& stop, const std::string& how_far) {
  std::cout << fmt::format("stopped by {} {}; the same command goes on\n", stop.Name(), how_far);
  throw CLI::RuntimeError(kStopped);
}

// An image that cannot be read, or is too small, has no descriptors.
Descriptors Describe(const fs::path& image, int max_side_px, FeatureExtractor& extractor) {
  std::string why;
  try {
    if (const auto pixels = ReadImageOfSide(image, max_side_px, &why)) {
      return extractor.Extract(*pixels).descriptors;
    }
  } catch (const InputError& error) {
    why = error.what();
  }
  std::cerr << fmt::format("warning: {}: left out: {}\n", image.string(), why);
  return {};
}

void ExtractAll(const VocabularyBuildArguments& arguments, const std::vector<fs::path>& images,
                const StopSignal& stop) {
  const auto extractor = arguments.features.MakeExtractor();
  const DescriptorKind& kind = extractor->descriptor_kind();
  DescriptorFileWriter writer(DescriptorsPath(arguments),
                              {kind, SourceSha256(arguments, images, kind)});
  ProgressBar bar;
  Progress progress{0, static_cast<std::int64_t>(images.size()), "extracting", kNoMap, 0};
  while (writer.num_images() < images.size()) {
    if (stop.Requested()) {
      EndStopped(stop, fmt::format("after {} of {} images", writer.num_images(), images.size()));
    }
    writer.AddImage(Describe(images[writer.num_images()], arguments.max_side_px, *extractor));
    progress.frames_done = static_cast<std::int64_t>(writer.num_images());
    bar.Update(progress);
  }
  progress.state = "extracted";
  progress.frames_done = static_cast<std::int64_t>(writer.num_images());
  bar.Finish(progress);
}

VocabularyTree Train(const VocabularyBuildArguments& arguments, const DescriptorFile& file,
                     const StopSignal& stop) {
  ProgressBar bar;
  Progress progress{0, 100, "training", kNoMap, 0};  // percents
  const auto tell = [&](const TrainingProgress& training) {
    progress.state = fmt::format("level {}", training.level);
    progress.frames_done =
        static_cast<std::int64_t>(100 * training.rows_done / training.rows_total);
    bar.Update(progress);
    return !stop.Requested();
  };
  auto tree =
      TrainVocabulary(file, arguments.training, WithSuffix(arguments.output, ".checkpoint"), tell);
  if (!tree) EndStopped(stop, fmt::format("in {}", progress.state));
  progress = {100, 100, "trained", kNoMap, 0};
  bar.Finish(progress);
  return std::move(*tree);
}

std::string Description(const VocabularyBuildArguments& arguments, std::size_t num_images) {
  std::string sources;
  for (const fs::path& source : arguments.sources) {
    sources +=
        (sources.empty() ? "" : ", ") + fs::absolute(source).lexically_normal().filename().string();
    if (sources.size() > 2000) break;
  }
  return fmt::format("{} images (step {}, longer side at most {} pixels) of: {}; seed {}",
                     num_images, arguments.step, arguments.max_side_px, sources,
                     arguments.training.seed);
}

void RemoveIfThere(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

void BuildVocabulary(const VocabularyBuildArguments& arguments) {
  arguments.training.Check();
  DisableImageThreads();
  const std::vector<fs::path> images = CollectImages(arguments.sources, arguments.step);
  const StopSignal stop;
  ExtractAll(arguments, images, stop);
  {
    const DescriptorFile file(DescriptorsPath(arguments));
    VocabularyTree tree = Train(arguments, file, stop);
    tree.description = Description(arguments, images.size());
    WriteVocabulary(tree, arguments.output);
  }
  RemoveIfThere(WithSuffix(arguments.output, ".checkpoint"));
  if (arguments.descriptors.empty()) RemoveIfThere(DescriptorsPath(arguments));
  const VocabularyInfo info = Vocabulary(arguments.output).info();
  std::cout << fmt::format("{}: {} words from {} descriptors of {} images, {:.1f} MB\n",
                           arguments.output.string(), info.num_words, info.num_rows,
                           info.num_images, static_cast<double>(info.num_bytes) * 1e-6);
}

}  // namespace lift_slam
