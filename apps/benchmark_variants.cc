#include "apps/benchmark_variants.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"

namespace lift_slam {
namespace {

BenchmarkVariant ReadVariant(const YAML::Node& node) {
  BenchmarkVariant variant{node["name"].as<std::string>(), node["title"].as<std::string>(), {}};
  if (node["set"]) variant.settings = node["set"].as<std::vector<std::string>>();
  return variant;
}

void CheckDifferent(const BenchmarkVariants& variants, const std::filesystem::path& file) {
  for (const BenchmarkVariant& variant : variants.variants) {
    const auto is_same = [&](const BenchmarkVariant& other) {
      return other.name == variant.name || other.title == variant.title;
    };
    if (std::ranges::count_if(variants.variants, is_same) == 1) continue;
    throw InputError(fmt::format("{}: name or title of the variant '{}' stands there twice",
                                 file.string(), variant.name));
  }
}

}  // namespace

BenchmarkVariants ReadBenchmarkVariants(const std::filesystem::path& file) {
  BenchmarkVariants variants;
  try {
    const YAML::Node root = YAML::Load(ReadText(file));
    variants.base = root["base"].as<std::string>();
    for (const YAML::Node& node : root["variants"]) variants.variants.push_back(ReadVariant(node));
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format(
        "{}: is no list of variants (expected base, and variants with name, title and set): {}",
        file.string(), error.what()));
  }
  if (variants.variants.empty()) {
    throw InputError(fmt::format("{}: lists no variants", file.string()));
  }
  CheckDifferent(variants, file);
  return variants;
}

const BenchmarkVariant& FindVariant(const BenchmarkVariants& variants, const std::string& name) {
  const auto found = std::ranges::find(variants.variants, name, &BenchmarkVariant::name);
  if (found != variants.variants.end()) return *found;
  std::vector<std::string> names;
  for (const BenchmarkVariant& variant : variants.variants) names.push_back(variant.name);
  throw InputError(fmt::format("variant '{}' is unknown; the nearest one is '{}'", name,
                               NearestName(name, names)));
}

}  // namespace lift_slam
