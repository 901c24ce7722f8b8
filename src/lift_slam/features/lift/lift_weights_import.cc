#include "lift_slam/features/lift/lift_weights_import.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "lift_slam/features/lift/hdf5_reader.h"
#include "lift_slam/nn/weight_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

// A name of ours and the same array in one of the released files.
struct Renaming {
  const char* ours;
  std::string theirs;
};

std::vector<Renaming> TheanoNames() {
  return {{"descriptor.conv1.weight", "l-1-weights"}, {"descriptor.conv1.bias", "l-1-bias"},
          {"descriptor.norm1.kernel", "l-4-filter"},  {"descriptor.conv2.weight", "l-5-weights"},
          {"descriptor.conv2.bias", "l-5-bias"},      {"descriptor.norm2.kernel", "l-8-filter"},
          {"descriptor.conv3.weight", "l-9-weights"}, {"descriptor.conv3.bias", "l-9-bias"}};
}

std::vector<Renaming> TensorFlowDescriptorNames() {
  return {{"descriptor.conv1.weight", "desc/conv1/weight"},
          {"descriptor.conv1.bias", "desc/conv1/bias"},
          {"descriptor.conv2.weight", "desc/conv2/weight"},
          {"descriptor.conv2.bias", "desc/conv2/bias"},
          {"descriptor.conv3.weight", "desc/conv3/weight"},
          {"descriptor.conv3.bias", "desc/conv3/bias"}};
}

std::string DetectorGroup(ReleasedDetector detector) {
  return fmt::format("kp_{}", kReleasedDetectorNames[static_cast<std::size_t>(detector)]);
}

std::vector<Renaming> DetectorNames(ReleasedDetector detector) {
  const std::string group = DetectorGroup(detector) + "/conv1/";
  return {{"detector.conv1.weight", group + "weight"}, {"detector.conv1.bias", group + "bias"}};
}

// The kernels are stored divided by the number of channels; ours sum to 1.
void NormalizeSum(std::span<float> kernel, const Hdf5Reader& file, const std::string& name) {
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  if (!(sum > 0)) {
    throw InputError(fmt::format("{}: '{}' must have a positive sum", file.path().string(), name));
  }
  for (float& v : kernel) v = static_cast<float>(v / sum);
}

void CopyArrays(const Hdf5Reader& file, const std::vector<Renaming>& names, LiftWeights& weights) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    for (const auto& [ours, theirs] : names) {
      if (parameter.name != ours) continue;
      Hdf5Reader::Array array = file.Read(theirs);
      std::erase(array.shape, 1);  // sizes of 1 come and go between the files
      std::vector<std::int64_t> expected = parameter.shape;
      std::erase(expected, 1);
      if (array.shape != expected) {
        throw InputError(fmt::format("{}: '{}' has shape {}, expected {}", file.path().string(),
                                     theirs, nn::ShapeText(array.shape), nn::ShapeText(expected)));
      }
      std::copy(array.values.begin(), array.values.end(), parameter.values.begin());
      if (parameter.name.ends_with(".kernel")) NormalizeSum(parameter.values, file, theirs);
    }
  }
}

InputNormalization TheanoNormalization(const Hdf5Reader& file) {
  const InputNormalization input{file.Read("patch-mean").values[0],
                                 file.Read("patch-std").values[0]};
  if (!(input.scale > 0)) {
    throw InputError(fmt::format("{}: 'patch-std' must be above 0", file.path().string()));
  }
  return input;
}

std::string FileNames(std::span<const std::filesystem::path> files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

// The first file that has an array of this name.
const Hdf5Reader& FileWith(const std::string& name, const char* what,
                           const std::vector<std::unique_ptr<Hdf5Reader>>& readers,
                           std::span<const std::filesystem::path> files) {
  for (const auto& reader : readers) {
    if (reader->Has(name)) return *reader;
  }
  throw InputError(
      fmt::format("{}: no {} in there ('{}' is missing); it is in another of the "
                  "released files",
                  FileNames(files), what, name));
}

}  // namespace

LiftWeights ImportLiftWeights(std::span<const std::filesystem::path> files,
                              const LiftImport& wanted) {
  std::vector<std::unique_ptr<Hdf5Reader>> readers;
  std::string provenance = "Released by the authors of LIFT; academic use only.";
  for (const auto& file : files) {
    readers.push_back(std::make_unique<Hdf5Reader>(file));
    provenance += fmt::format(" Imported from {} (SHA-256 {}).", file.filename().string(),
                              Sha256Hex(ReadText(file)));
  }
  LiftWeights weights = ZeroLiftWeights(wanted.topology, /*with_orientation=*/false);
  const std::string detector = DetectorGroup(wanted.detector);
  CopyArrays(FileWith(detector + "/conv1/weight", "detector", readers, files),
             DetectorNames(wanted.detector), weights);
  if (wanted.topology == LiftTopology::kT) {
    const Hdf5Reader& file = FileWith("l-1-weights", "descriptor of topology T", readers, files);
    CopyArrays(file, TheanoNames(), weights);
    weights.descriptor_input = TheanoNormalization(file);
  } else {
    CopyArrays(FileWith("desc/conv1/weight", "descriptor of topology F", readers, files),
               TensorFlowDescriptorNames(), weights);
  }
  weights.name = fmt::format("lift-released-{}-{}", Name(wanted.topology), detector);
  weights.provenance = provenance;
  return weights;
}

}  // namespace lift_slam
