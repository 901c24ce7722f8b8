#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam extract IMAGE...`: LIFT features of images, as NPZ files and pictures; with --patches
// descriptors of given patches.
void AddExtractCommand(CLI::App& app);

}  // namespace lift_slam
