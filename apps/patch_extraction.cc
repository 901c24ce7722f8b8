#include "apps/patch_extraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <optional>

#include "apps/npz_file.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::size_t kPatchPixels = std::size_t{kLiftPatchSize} * kLiftPatchSize;

// The N of "N,64,64"; nothing when it is something else.
std::optional<std::size_t> CountOf(const std::string& shape) {
  const std::string rest = fmt::format(",{0},{0}", kLiftPatchSize);
  if (!shape.ends_with(rest)) return std::nullopt;
  std::size_t count = 0;
  const char* last = shape.data() + shape.size() - rest.size();
  const auto [end, error] = std::from_chars(shape.data(), last, count);
  const bool is_number = error == std::errc() && end == last && count > 0 && count < 1U << 24U;
  return is_number ? std::optional(count) : std::nullopt;
}

std::vector<std::uint8_t> ReadPatches(const PatchExtraction& wanted) {
  const std::string bytes = ReadText(wanted.patches);
  if (wanted.shape.empty()) {
    if (bytes.empty() || bytes.size() % kPatchPixels != 0) {
      throw InputError(fmt::format("{}: {} bytes are no whole number of patches of {} x {}",
                                   wanted.patches.string(), bytes.size(), kLiftPatchSize,
                                   kLiftPatchSize));
    }
  } else {
    const std::optional<std::size_t> count = CountOf(wanted.shape);
    if (!count) {
      throw InputError(fmt::format("--shape '{}': expected N,{},{} with N at least 1", wanted.shape,
                                   kLiftPatchSize, kLiftPatchSize));
    }
    if (bytes.size() != *count * kPatchPixels) {
      throw InputError(fmt::format("{}: has {} bytes, but --shape {} needs {}",
                                   wanted.patches.string(), bytes.size(), wanted.shape,
                                   *count * kPatchPixels));
    }
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::filesystem::path AnglesFile(const std::filesystem::path& output) {
  return output.parent_path() / (output.stem().string() + "_angles.npy");
}

void ExtractPatches(const PatchExtraction& wanted) {
  if (wanted.output.extension() != ".npy") {
    throw InputError("extract --patches writes one file: --output must end in .npy");
  }
  const LiftWeights weights = ReadLiftWeightsOrDefault(wanted.weights);
  if (wanted.orientation && !weights.orientation) {
    throw InputError(fmt::format("the weights '{}' have no orientation network for --orientation",
                                 weights.name));
  }
  const std::vector<std::uint8_t> patches = ReadPatches(wanted);
  const std::size_t count = patches.size() / kPatchPixels;
  LiftNetworks networks(weights,
                        {.precision = wanted.precision, .num_threads = wanted.num_threads});
  WriteNpy(wanted.output, {count, kLiftDescriptorSize},
           networks.DescribePatches(std::span(patches)));
  if (wanted.orientation)
    WriteNpy(AnglesFile(wanted.output), {count}, networks.OrientPatches(patches));
  std::string reason = networks.precision().reason;
  if (!reason.empty()) reason = fmt::format(" ({})", reason);
  std::cout << fmt::format("{}: descriptors of {} patches in {}{}\n", wanted.output.string(), count,
                           nn::Name(networks.precision().used), reason);
}

}  // namespace lift_slam
