#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lift_slam {

// What `lift_slam benchmark WHAT` asks for: words is SUITE, "plan SUITE", "run-job K", "merge" or
// "results". Throws InputError when a word is missing or too many, and when an option was given
// that this would leave unread (`run-job 3 --set ...`: the plan says how a run goes).
void CheckBenchmarkUsage(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace lift_slam
