#pragma once

#include <string>

#include "lift_slam/visualization/report_scene.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {

// A plot with what is written above and below it.
struct Figure {
  std::string title;
  Plot plot;
  std::string note;  // a sentence under the plot; may be empty
};

// Path (and ground truth) from above, with its start and end.
Figure TopViewFigure(const ReportScene& scene, const ScenePath& path);
// Height against time; all maps.
Figure HeightFigure(const ReportScene& scene);
// Distance to the ground truth against time.
Figure ErrorFigure(const ReportScene& scene, const ReportData& data);
// Tracked points of each frame, with the states behind and the keyframes below. When no frame has
// a pose: features and matches instead.
Figure TrackingFigure(const RunRecord& run);
// Adaptive thresholds of each frame, and below them what moves them: the matches with the last
// frame's points and the outliers of these (paper Fig. 5). Empty when the thresholds were fixed.
std::vector<Figure> ThresholdFigures(const RunRecord& run);
// Extraction, tracking and mapping of each frame.
Figure StageTimesFigure(const RunRecord& run);
// Points of a path's map from above, with path and keyframes.
Figure MapFigure(const RunRecord& run, const ReportScene& scene, const ScenePath& path);

}  // namespace lift_slam
