#include "lift_slam/features/orb/orb_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

template <class T>
void CheckRange(std::string_view name, T value, T low, T high) {
  if (value >= low && value <= high) return;  // false for NaN too
  throw InputError(fmt::format("option 'orb.{}' is {}, expected {} to {}", name, value, low, high));
}

}  // namespace

void OrbOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_features", max_features,
                "features per image; 0: by area, 2000 for 1241 x 376, within 500 to 6000");
  visitor.Field("num_levels", num_levels, "pyramid levels");
  visitor.Field("scale_factor", scale_factor, "size ratio of neighbouring pyramid levels");
  visitor.Field("fast_threshold", fast_threshold, "FAST contrast in grey levels");
  visitor.Field("min_fast_threshold", min_fast_threshold,
                "FAST contrast in cells without a corner above fast_threshold");
  visitor.Field("cell_size_px", cell_size_px, "side of those cells");
  visitor.Field("subpixel", subpixel, "corner positions below a pixel");
  visitor.Field("sigma_px", sigma_px, "noise of a position on the full-size level");
  visitor.Field("num_threads", num_threads, "threads that share the pyramid levels");
}

void OrbOptions::Check() const {
  CheckRange("max_features", max_features, 0, 100000);
  CheckRange("num_levels", num_levels, 1, 32);
  CheckRange("scale_factor", scale_factor, 1.01, 4.0);
  CheckRange("fast_threshold", fast_threshold, 1, 254);
  CheckRange("min_fast_threshold", min_fast_threshold, 1, fast_threshold);
  CheckRange("cell_size_px", cell_size_px, 8, 1000);
  CheckRange("sigma_px", sigma_px, 0.01, 100.0);
  CheckRange("num_threads", num_threads, 1, 64);
}

int FeatureCount(const OrbOptions& options, int width, int height) {
  if (options.max_features > 0) return options.max_features;
  constexpr double kFeaturesPerPixel = 2000.0 / (1241.0 * 376.0);
  const double by_area = std::round(kFeaturesPerPixel * width * height);
  return static_cast<int>(std::clamp(by_area, 500.0, 6000.0));
}

}  // namespace lift_slam
