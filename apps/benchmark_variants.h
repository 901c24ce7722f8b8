#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lift_slam {

// A system of the ablation: the base preset with some settings changed.
struct BenchmarkVariant {
  std::string name, title;            // "no_loops", "without loop closing"
  std::vector<std::string> settings;  // key=value
};

struct BenchmarkVariants {
  std::string base;                        // preset or .yaml file
  std::vector<BenchmarkVariant> variants;  // in the order of the tables, at least one
};

// A file as configs/ablation.yaml. Throws InputError naming the file for what is no such file, and
// for a name or title that stands twice.
BenchmarkVariants ReadBenchmarkVariants(const std::filesystem::path& file);

// That named `name`; throws InputError naming the nearest one.
const BenchmarkVariant& FindVariant(const BenchmarkVariants& variants, const std::string& name);

}  // namespace lift_slam
