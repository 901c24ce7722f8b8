#include "lift_slam/slam/slam_options.h"

#include <string>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_paths.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
namespace {

struct Range {
  std::string_view name;  // of the field, in whatever group
  double low, high;
};

constexpr double kMost = 1e9;
constexpr double kMostIterations = 1e5;  // more would seem to hang
// No option may be negative; these may not be 0 either: that many rounds do nothing, and a limit or
// a standard deviation of 0 excludes everything.
constexpr Range kRanges[] = {
    {"num_threads", 1, 256},
    {"max_iterations", 1, kMostIterations},
    {"robust_iterations", 1, kMostIterations},
    {"plain_iterations", 1, kMostIterations},
    {"iterations_per_round", 1, kMostIterations},
    {"rounds", 1, 1000},
    {"limit_factor", 1, kMost},
    {"max_squared_error", 1e-6, kMost},
    {"sigma_factor", 0.01, 10},
    {"focal_scale_sigma", 1e-9, kMost},
    {"k1_sigma", 1e-9, kMost},
    {"loop_edge_weight", 1e-6, kMost},
};

class RangeChecker final : public OptionVisitor {
 public:
  void Field(std::string_view, bool&, std::string_view) override {}
  void Field(std::string_view, std::string&, std::string_view) override {}
  void Field(std::string_view name, int& value, std::string_view) override { Check(name, value); }
  void Field(std::string_view name, double& value, std::string_view) override {
    Check(name, value);
  }
  void Choice(std::string_view, int&, std::span<const std::string_view>,
              std::string_view) override {}

 protected:
  void BeginGroup(std::string_view name, std::string_view) override { place_.Enter(name); }
  void EndGroup() override { place_.Leave(); }

 private:
  void Check(std::string_view name, double value) const {
    const std::string path = place_.Path(name);
    if (path.starts_with("lift.")) return;  // checked by LIFT itself: 0 is "as the machine has"
    Range range{name, 0.0, kMost};
    for (const Range& other : kRanges) {
      if (other.name == name) range = other;
    }
    CheckOptionRange("slam." + path, value, range.low, range.high);
  }

  OptionPlace place_;
};

}  // namespace

void SlamOptions::Check() const {
  SlamOptions copy = *this;
  RangeChecker checker;
  copy.Visit(checker);
  matching.Check();
  tracker.motion_prior.Check();
  const bool sets_thresholds = features.lift.low_threshold > 0 || features.lift.high_threshold > 0;
  if (features.type == FeatureType::kLift && sets_thresholds &&
      matching.thresholds == ThresholdMode::kAdaptive) {
    throw InputError(
        "slam.lift.low_threshold and high_threshold are of fixed thresholds, expected "
        "slam.matching.thresholds=fixed with them");
  }
}

BundleOptions SlamOptions::FinalBundleDefaults() {
  BundleOptions options;
  // To the end: what loops leave is smooth along the way, costs little and goes away slowly.
  options.plain_iterations = 50;
  options.function_tolerance = 1e-6;
  return options;
}

}  // namespace lift_slam
