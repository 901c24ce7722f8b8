#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam match A B`: features of two images matched and checked by the epipolar geometry, as a
// picture and as counts (paper fig. 3).
void AddMatchCommand(CLI::App& app);

}  // namespace lift_slam
