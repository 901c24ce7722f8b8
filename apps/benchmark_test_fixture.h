#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string>

#include "apps/run_test_fixture.h"

namespace lift_slam {

// Whole benchmarks on small rendered trees of KITTI's and EuRoC's form.
class BenchmarkCommand : public RunCommand {
 protected:
  // `lift_slam benchmark ARGUMENTS` with the smallest settings that still give a map.
  std::string Arguments(const std::string& what,
                        const std::string& systems = "default_orb orb_slam") const {
    return fmt::format("benchmark {} --data {} --output {} --systems {}", what,
                       (folder_ / "data").string(), output_.string(), systems);
  }
  std::set<std::string> Finished() const {
    std::set<std::string> names;
    if (!std::filesystem::is_directory(output_ / "results")) return names;
    for (const std::filesystem::path& path : FilesIn(output_ / "results"))
      names.insert(path.filename());
    return names;
  }
};

}  // namespace lift_slam
