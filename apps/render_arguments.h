#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/simulation/render_options.h"

namespace CLI {
class App;
}

namespace lift_slam {

// The command line of `lift_slam render`.
struct RenderArguments {
  std::string scene;
  std::filesystem::path output, video, config_file, camera_file, poses_file;
  std::vector<std::string> overrides;
  std::string size, frames;
  std::optional<double> laps, extra_m, rate_hz;
  std::optional<int> seed;
  int num_threads = 0;  // 0: as many as the machine has
  bool depth = false, color = false, pairs = false;
  bool list = false, print_options = false;

  // Adds them to a command; *this must outlive it.
  void AddTo(CLI::App& command);
  // The defaults, changed by --config, --camera, --size, --set and the other arguments, in this
  // order. Throws InputError for an unknown option and for values that cannot be.
  RenderOptions Options() const;
};

}  // namespace lift_slam
