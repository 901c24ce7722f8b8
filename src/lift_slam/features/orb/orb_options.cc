#include "lift_slam/features/orb/orb_options.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/util/option_range.h"

namespace lift_slam {
void OrbOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_features", max_features,
                "features per image; 0: by area, 2000 for 1241 x 376, within 1200 to 6000");
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
  CheckOptionRange("orb.max_features", max_features, 0, 100000);
  CheckOptionRange("orb.num_levels", num_levels, 1, 32);
  CheckOptionRange("orb.scale_factor", scale_factor, 1.01, 4.0);
  CheckOptionRange("orb.fast_threshold", fast_threshold, 1, 254);
  CheckOptionRange("orb.min_fast_threshold", min_fast_threshold, 1, fast_threshold);
  CheckOptionRange("orb.cell_size_px", cell_size_px, 8, 1000);
  CheckOptionRange("orb.sigma_px", sigma_px, 0.01, 100.0);
  CheckOptionRange("orb.num_threads", num_threads, 1, 64);
}

int FeatureCount(const OrbOptions& options, int width, int height) {
  if (options.max_features > 0) return options.max_features;
  constexpr double kFeaturesPerPixel = 2000.0 / (1241.0 * 376.0);
  const double by_area = std::round(kFeaturesPerPixel * width * height);
  return static_cast<int>(std::clamp(by_area, 1200.0, 6000.0));
}

}  // namespace lift_slam
