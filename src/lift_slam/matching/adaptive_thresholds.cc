#include "lift_slam/matching/adaptive_thresholds.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/util/check.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {

void MatchingOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("thresholds", thresholds, kThresholdModeNames,
                "distances up to which descriptors match: those of the features, or moved with the "
                "number of matches");
  visitor.Field("plenty", plenty, "good matches from which adaptive thresholds are strict");
  visitor.Field("few", few, "good matches below which adaptive thresholds are loose");
  visitor.Field("max_fall", max_fall,
                "largest fall of adaptive thresholds a frame, of their range");
  visitor.Field("dead_band", dead_band, "smallest change of adaptive thresholds, of their range");
}

void MatchingOptions::Check() const {
  CheckOptionRange("matching.few", few, 0, 100000);
  CheckOptionRange("matching.plenty", plenty, few + 1, 100001);
  CheckOptionRange("matching.max_fall", max_fall, 0.0, 1.0);
  CheckOptionRange("matching.dead_band", dead_band, 0.0, 1.0);
}

MatchingThresholds AdaptiveThresholds::In(const ThresholdRange& range, ThresholdMode mode) const {
  if (mode == ThresholdMode::kFixed) return range.fixed;
  const auto share = static_cast<float>(looseness);
  return {std::lerp(range.strict.low, range.loose.low, share),
          std::lerp(range.strict.high, range.loose.high, share)};
}

AdaptiveThresholds Adapt(const AdaptiveThresholds& current, const MatchingOptions& options,
                         int num_matches, int num_outliers) {
  LIFT_SLAM_CHECK(num_outliers <= num_matches, "{} outliers of {} matches", num_outliers,
                  num_matches);
  const int good = num_matches - num_outliers;
  const double wanted = std::clamp(
      static_cast<double>(options.plenty - good) / (options.plenty - options.few), 0.0, 1.0);
  // The ends are always reached.
  const bool at_end = wanted == 0.0 || wanted == 1.0;
  if (!at_end && std::abs(wanted - current.looseness) < options.dead_band) return current;
  return {std::max(wanted, current.looseness - options.max_fall)};
}

}  // namespace lift_slam
