#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam render`: a scene to a sequence with exact ground truth. The callback throws
// InputError, and CLI::RuntimeError(kStopped) when a signal ended it before all frames were there.
void AddRenderCommand(CLI::App& app);

}  // namespace lift_slam
