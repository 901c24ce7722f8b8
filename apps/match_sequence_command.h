#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam match-sequence`: how features match over many pairs of images of a sequence; one job
// of `lift_slam benchmark matching`.
void AddMatchSequenceCommand(CLI::App& app);

}  // namespace lift_slam
