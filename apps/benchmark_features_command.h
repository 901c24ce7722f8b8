#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam benchmark-features`: how well LIFT weights, ORB and SIFT describe and find again what
// real images show; tables in Markdown, and a plot.
void AddBenchmarkFeaturesCommand(CLI::App& app);

}  // namespace lift_slam
