#include "lift_slam/features/lift/lift_weights.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lift_slam/nn/weight_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"

namespace lift_slam {
namespace {

constexpr const char* kFormat = "lift_slam LIFT weights 1";
constexpr const char* kPercentages = "the 5, 25, 50, 75 and 95 % quantiles";

// Takes the metadata apart; every complaint names the file and the key.
class MetadataReader {
 public:
  MetadataReader(const std::filesystem::path& path, const nn::WeightFile& file)
      : path_(path.string()), metadata_(file.metadata) {}

  std::string Text(const std::string& key) const {
    const auto found = metadata_.find(key);
    if (found == metadata_.end()) {
      throw InputError(fmt::format("{}: metadata '{}' is missing", path_, key));
    }
    return found->second;
  }

  // Finite numbers separated by blanks; none when the key is missing.
  std::vector<float> Numbers(const std::string& key) const {
    if (!metadata_.contains(key)) return {};
    std::istringstream text(Text(key));
    std::vector<float> numbers;
    for (float number; text >> number;) numbers.push_back(number);
    const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                    [](float number) { return std::isfinite(number); });
    if (!text.eof() || !finite) {
      throw InputError(
          fmt::format("{}: metadata '{}' is '{}', expected numbers", path_, key, Text(key)));
    }
    return numbers;
  }

  InputNormalization Normalization(const std::string& module) const {
    const std::string key = module + ".input";
    const std::vector<float> numbers = Numbers(key);
    if (numbers.size() != 2 || numbers[1] <= 0) {
      throw InputError(
          fmt::format("{}: metadata '{}' must be the mean and the scale (above 0) of "
                      "the input, as \"128 128\"",
                      path_, key));
    }
    return {numbers[0], numbers[1]};
  }

  std::optional<std::array<float, 5>> Quantiles(const std::string& key) const {
    const std::vector<float> numbers = Numbers(key);
    if (numbers.empty()) return std::nullopt;
    std::array<float, 5> quantiles{};
    if (numbers.size() != quantiles.size() || !std::is_sorted(numbers.begin(), numbers.end()) ||
        numbers[0] < 0) {
      throw InputError(
          fmt::format("{}: metadata '{}' must be {}, ascending", path_, key, kPercentages));
    }
    std::copy(numbers.begin(), numbers.end(), quantiles.begin());
    return quantiles;
  }

 private:
  std::string path_;
  const std::map<std::string, std::string>& metadata_;
};

LiftTopology ReadTopology(const std::filesystem::path& path, const std::string& text) {
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    if (text == Name(topology)) return topology;
  }
  throw InputError(
      fmt::format("{}: topology '{}' is unknown, expected F or T", path.string(), text));
}

void ReadTensors(const std::filesystem::path& path, const nn::WeightFile& file,
                 LiftWeights& weights) {
  std::vector<std::string> names;
  for (const LiftParameter& parameter : Parameters(weights)) {
    names.push_back(parameter.name);
    const auto found = file.tensors.find(parameter.name);
    if (found == file.tensors.end()) {
      throw InputError(fmt::format("{}: tensor '{}' {} is missing (topology {})", path.string(),
                                   parameter.name, nn::ShapeText(parameter.shape),
                                   Name(weights.topology)));
    }
    if (found->second.shape != parameter.shape) {
      throw InputError(fmt::format("{}: tensor '{}' has shape {}, expected {}", path.string(),
                                   parameter.name, nn::ShapeText(found->second.shape),
                                   nn::ShapeText(parameter.shape)));
    }
    std::copy(found->second.values.begin(), found->second.values.end(), parameter.values.begin());
  }
  for (const auto& [name, entry] : file.tensors) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw InputError(
          fmt::format("{}: unknown tensor '{}' (topology {}); the nearest known is "
                      "'{}'",
                      path.string(), name, Name(weights.topology), NearestName(name, names)));
    }
  }
}

void ReadMetadata(const std::filesystem::path& path, const MetadataReader& metadata,
                  LiftWeights& weights) {
  weights.name = metadata.Text("name");
  weights.provenance = metadata.Text("provenance");
  weights.detector_input = metadata.Normalization("detector");
  if (weights.orientation) weights.orientation_input = metadata.Normalization("orientation");
  weights.descriptor_input = metadata.Normalization("descriptor");
  const auto matching = metadata.Quantiles("distances.matching");
  const auto wrong = metadata.Quantiles("distances.nearest_wrong");
  if (matching.has_value() != wrong.has_value()) {
    throw InputError(
        fmt::format("{}: metadata 'distances.matching' and 'distances.nearest_wrong' "
                    "go together",
                    path.string()));
  }
  if (matching) weights.distances = DistanceQuantiles{*matching, *wrong};
  weights.descriptor_ranges = metadata.Numbers("descriptor.ranges");
  const auto convolutions = std::count_if(
      weights.descriptor.begin(), weights.descriptor.end(),
      [](const auto& layer) { return std::holds_alternative<nn::Convolution>(layer); });
  if (!weights.descriptor_ranges.empty() && std::ssize(weights.descriptor_ranges) != convolutions) {
    throw InputError(fmt::format("{}: metadata 'descriptor.ranges' must be {} numbers",
                                 path.string(), convolutions));
  }
}

std::string NormalizationText(const InputNormalization& normalization) {
  return fmt::format("{} {}", normalization.mean, normalization.scale);
}

}  // namespace

std::string_view Name(LiftTopology topology) {
  return kLiftTopologyNames[static_cast<std::size_t>(topology)];
}

LiftWeights ReadLiftWeights(const std::filesystem::path& path) {
  const nn::WeightFile file = nn::ReadWeightFile(path);
  const auto format = file.metadata.find("format");
  if (format == file.metadata.end() || format->second != kFormat) {
    throw InputError(
        fmt::format("{}: not a file of LIFT weights (metadata 'format' must be '{}'); "
                    "'lift_slam weights import' makes one",
                    path.string(), kFormat));
  }
  const MetadataReader metadata(path, file);
  const bool with_orientation =
      std::any_of(file.tensors.begin(), file.tensors.end(),
                  [](const auto& tensor) { return tensor.first.starts_with("orientation."); });
  LiftWeights weights =
      ZeroLiftWeights(ReadTopology(path, metadata.Text("topology")), with_orientation);
  ReadTensors(path, file, weights);
  ReadMetadata(path, metadata, weights);
  weights.sha256 = file.sha256;
  return weights;
}

void WriteLiftWeights(LiftWeights& weights, const std::filesystem::path& path) {
  nn::WeightFile file;
  for (const LiftParameter& parameter : Parameters(weights)) {
    file.tensors[parameter.name] = {parameter.shape,
                                    {parameter.values.begin(), parameter.values.end()}};
  }
  file.metadata = {{"format", kFormat},
                   {"name", weights.name},
                   {"topology", std::string(Name(weights.topology))},
                   {"provenance", weights.provenance},
                   {"detector.input", NormalizationText(weights.detector_input)},
                   {"descriptor.input", NormalizationText(weights.descriptor_input)}};
  if (weights.orientation) {
    file.metadata["orientation.input"] = NormalizationText(weights.orientation_input);
  }
  if (weights.distances) {
    file.metadata["distances.matching"] =
        fmt::format("{}", fmt::join(weights.distances->matching, " "));
    file.metadata["distances.nearest_wrong"] =
        fmt::format("{}", fmt::join(weights.distances->nearest_wrong, " "));
  }
  if (!weights.descriptor_ranges.empty()) {
    file.metadata["descriptor.ranges"] =
        fmt::format("{}", fmt::join(weights.descriptor_ranges, " "));
  }
  weights.sha256 = nn::WriteWeightFile(file, path);
}

}  // namespace lift_slam
