#pragma once

#include "lift_slam/visualization/report_scene.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {

// The part of a map worth showing from above: all of the path and the middle 96 % of the points.
struct MapExtent {
  double right_min = 0.0, right_max = 1.0, up_min = 0.0, up_max = 1.0;
};
// Grown to `aspect` (width / height).
MapExtent ExtentOf(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                   double aspect);

// The points of the path's map from above as a transparent PNG, in grey levels that can be seen on
// light and on dark; `long_side_px` is its larger size.
PlotImage RasterOfPoints(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                         const MapExtent& extent, int long_side_px);

}  // namespace lift_slam
