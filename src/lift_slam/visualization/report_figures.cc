#include "lift_slam/visualization/report_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "lift_slam/visualization/map_raster.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr int kMaxBars = 320;
constexpr double kMapPlotAspect = 482.0 / 408.0;  // frame of a 560 x 480 plot with one legend row
constexpr std::array kMapColors = {PlotColor::kBlue, PlotColor::kVermilion, PlotColor::kGreen,
                                   PlotColor::kPurple, PlotColor::kSky};

PlotColor ColorOfMap(int map_index) {
  return kMapColors[static_cast<std::size_t>(std::max(0, map_index)) % kMapColors.size()];
}

std::string PathLabel(const ReportScene& scene, const ScenePath& path) {
  return scene.paths().size() == 1 ? "estimate" : fmt::format("map {}", path.map_index + 1);
}

void AddTruth(const ReportScene& scene, const std::vector<double>& x, const std::vector<double>& y,
              Plot& plot) {
  if (scene.truth().empty()) return;
  plot.series.push_back({"ground truth", SeriesKind::kLine, PlotColor::kGray, x, y, 4.5});
}

// Open circle at the first, filled circle at the last position.
void AddStartAndEnd(const ScenePath& path, PlotColor color, Plot& plot) {
  PlotSeries start{"start", SeriesKind::kRings, color, {}, {}, 9.0};
  PlotSeries end{"end", SeriesKind::kPoints, color, {}, {}, 8.0};
  for (std::size_t i = 0; i < path.right.size(); ++i) {
    if (!std::isfinite(path.right[i])) continue;
    if (start.x.empty()) start.x = {path.right[i]}, start.y = {path.up[i]};
    end.x = {path.right[i]};
    end.y = {path.up[i]};
  }
  if (start.x.empty()) return;
  plot.series.push_back(std::move(start));
  plot.series.push_back(std::move(end));
}

// Where a frame is on the page; nothing when it has no final pose or belongs to another path.
std::optional<Eigen::Vector3d> PlaceOfFrame(const RunRecord& run, const ReportScene& scene,
                                            const ScenePath& path, std::int64_t frame_index) {
  for (std::size_t i = 0; i < run.final_trajectory.size(); ++i) {
    const TrajectoryPose& pose = run.final_trajectory[i];
    if (pose.frame_index != frame_index) continue;
    if (pose.state != PoseState::kOk || i >= run.frames.size()) return std::nullopt;
    if (!scene.Shows(path, run.frames[i].map_index)) return std::nullopt;
    return scene.OnPage(pose.world_from_cam.translation);
  }
  return std::nullopt;
}

// Accepted places as lines between both frames, relocalisations as rings.
void AddPlaceEdges(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                   Plot& plot) {
  PlotSeries loops{"loop", SeriesKind::kLine, PlotColor::kOrange, {}, {}, 2.4};
  PlotSeries merges{"merge of maps", SeriesKind::kLine, PlotColor::kPurple, {}, {}, 2.4};
  PlotSeries found{"relocalised", SeriesKind::kRings, PlotColor::kVermilion, {}, {}, 7.0};
  for (const PlaceEvent& event : run.place_events) {
    if (event.rejection != PlaceRejection::kAccepted) continue;
    const auto a = PlaceOfFrame(run, scene, path, event.frame_index);
    const auto b = PlaceOfFrame(run, scene, path, event.other_frame_index);
    if (!a) continue;
    if (event.kind == PlaceEventKind::kRelocalisation) {
      found.x.push_back(a->x());
      found.y.push_back(a->y());
    } else if (b) {
      PlotSeries& series = event.kind == PlaceEventKind::kLoop ? loops : merges;
      series.x.insert(series.x.end(), {a->x(), b->x(), kGap});
      series.y.insert(series.y.end(), {a->y(), b->y(), kGap});
    }
  }
  for (PlotSeries* series : {&loops, &merges, &found}) {
    if (!series->x.empty()) plot.series.push_back(std::move(*series));
  }
}

Plot TopViewPlot(const ReportScene& scene) {
  Plot plot;
  plot.equal_aspect = true;
  plot.x.label = scene.RightLabel();
  plot.y.label = scene.UpLabel();
  plot.height_px = 480;
  return plot;
}

// The same for all plots against time.
PlotAxis TimeAxis(const ReportScene& scene) {
  PlotAxis axis{"time [s]", false, 0.0, {}};
  if (scene.duration_s() > 0.0) axis.max = scene.duration_s();
  return axis;
}

struct StateLook {
  const char* label;
  PlotColor color;
  bool tinted;
};

StateLook LookOf(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return {"initializing", PlotColor::kOrange, true};
    case TrackingState::kTracking:
      return {"tracking", PlotColor::kGreen, false};
    case TrackingState::kLost:
      return {"lost", PlotColor::kVermilion, true};
  }
  return {"", PlotColor::kInk, false};
}

// One band for each stretch of frames in the same state.
std::vector<PlotBand> StateBands(const RunRecord& run) {
  std::vector<PlotBand> bands;
  const auto& frames = run.frames;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i;
    while (end < frames.size() && frames[end].state == frames[i].state) ++end;
    const StateLook look = LookOf(frames[i].state);
    const std::int64_t next =
        end < frames.size() ? frames[end].frame_index : frames[end - 1].frame_index + 1;
    bands.push_back({look.label, look.color, static_cast<double>(frames[i].frame_index) - 0.5,
                     static_cast<double>(next) - 0.5, look.tinted});
    i = end;
  }
  return bands;
}

template <class Value>
PlotSeries FrameSeries(const RunRecord& run, const char* label, PlotColor color, Value&& value) {
  PlotSeries series{label, SeriesKind::kLine, color, {}, {}, 1.5};
  for (const FrameRecord& frame : run.frames) {
    series.x.push_back(static_cast<double>(frame.frame_index));
    series.y.push_back(value(frame));
  }
  return series;
}

bool AnyPose(const RunRecord& run) {
  return std::any_of(run.frames.begin(), run.frames.end(),
                     [](const FrameRecord& frame) { return frame.world_from_cam.has_value(); });
}

PlotSeries KeyframeRug(const RunRecord& run) {
  PlotSeries rug{"keyframe", SeriesKind::kRug, PlotColor::kInk, {}, {}, 1.0};
  for (const FrameRecord& frame : run.frames) {
    if (frame.is_keyframe) rug.x.push_back(static_cast<double>(frame.frame_index));
  }
  return rug;
}

// The frames' times, `per_bar` frames averaged into one bar.
PlotSeries TimeBars(const RunRecord& run, std::size_t per_bar, const char* label, PlotColor color,
                    double FrameRecord::*time_ms) {
  PlotSeries bars{label, SeriesKind::kStackedBars, color, {}, {}, 1.0};
  for (std::size_t i = 0; i < run.frames.size(); i += per_bar) {
    const std::size_t end = std::min(i + per_bar, run.frames.size());
    double sum_ms = 0.0, sum_index = 0.0;
    for (std::size_t k = i; k < end; ++k) {
      sum_ms += run.frames[k].*time_ms;
      sum_index += static_cast<double>(run.frames[k].frame_index);
    }
    bars.x.push_back(sum_index / static_cast<double>(end - i));
    bars.y.push_back(sum_ms / static_cast<double>(end - i));
  }
  return bars;
}

// Keeps a few very slow bars from flattening all others; returns how many reach beyond the frame.
int LimitHeight(Plot& plot) {
  std::vector<double> totals(plot.series.front().y.size(), 0.0);
  for (const PlotSeries& series : plot.series) {
    for (std::size_t i = 0; i < totals.size(); ++i) totals[i] += series.y[i];
  }
  if (totals.size() < 20) return 0;
  std::vector<double> sorted = totals;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() * 97 / 100];
  if (usual <= 0.0 || sorted.back() < 2.5 * usual) return 0;
  plot.y.max = 1.4 * usual;
  return static_cast<int>(
      std::count_if(totals.begin(), totals.end(), [&](double t) { return t > *plot.y.max; }));
}

std::string StageNote(const RunRecord& run, std::size_t per_bar, int beyond) {
  std::string note;
  if (per_bar > 1) note = fmt::format("Each bar is the mean of {} frames. ", per_bar);
  if (beyond > 0) {
    double slowest = 0.0;
    for (const FrameRecord& frame : run.frames) {
      slowest = std::max(slowest, frame.extract_ms + frame.track_ms + frame.map_ms);
    }
    note += fmt::format("{} bar{} beyond the top; the slowest frame took {} ms.", beyond,
                        beyond == 1 ? " reaches" : "s reach", FormatNumber(slowest, 3));
  }
  return note;
}

}  // namespace

Figure TopViewFigure(const RunRecord& run, const ReportScene& scene, const ScenePath& path) {
  Figure figure{"Top view", TopViewPlot(scene), {}};
  Plot& plot = figure.plot;
  plot.description = "Trajectory from above";
  AddTruth(scene, scene.truth().right, scene.truth().up, plot);
  const PlotColor color = ColorOfMap(path.map_index);
  plot.series.push_back(
      {PathLabel(scene, path), SeriesKind::kLine, color, path.right, path.up, 1.8});
  AddStartAndEnd(path, color, plot);
  AddPlaceEdges(run, scene, path, plot);
  return figure;
}

Figure HeightFigure(const ReportScene& scene) {
  Figure figure{"Height", {}, {}};
  Plot& plot = figure.plot;
  plot.description = "Height of the camera over time";
  plot.x = TimeAxis(scene);
  plot.y.label = scene.HeightLabel();
  AddTruth(scene, scene.truth().time_s, scene.truth().height, plot);
  for (const ScenePath& path : scene.paths()) {
    plot.series.push_back({PathLabel(scene, path), SeriesKind::kLine, ColorOfMap(path.map_index),
                           path.time_s, path.height, 1.6});
  }
  return figure;
}

Figure ErrorFigure(const ReportScene& scene, const ReportData& data) {
  Figure figure{"Position error", {}, {}};
  Plot& plot = figure.plot;
  plot.description = "Distance to the ground truth over time";
  plot.x = TimeAxis(scene);
  plot.y.label = "error [m]";
  plot.y.min = 0.0;
  PlotSeries series{"error", SeriesKind::kLine, PlotColor::kBlue, {}, {}, 1.6};
  std::vector<double> steps;
  for (std::size_t i = 1; i < data.errors.size(); ++i) {
    steps.push_back(
        static_cast<double>(data.errors[i].timestamp_ns - data.errors[i - 1].timestamp_ns));
  }
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual_step = sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < data.errors.size(); ++i) {
    if (i > 0 && steps[i - 1] > 3.5 * usual_step) {
      series.x.push_back(kGap);
      series.y.push_back(kGap);
    }
    series.x.push_back(scene.Seconds(data.errors[i].timestamp_ns));
    series.y.push_back(data.errors[i].error_m);
  }
  plot.series.push_back(std::move(series));
  plot.levels.push_back({fmt::format("RMSE {} m", FormatNumber(data.ate_rmse_m, 3)),
                         PlotColor::kVermilion, data.ate_rmse_m});
  return figure;
}

Figure TrackingFigure(const RunRecord& run) {
  Figure figure{"Tracked points per frame", {}, {}};
  Plot& plot = figure.plot;
  plot.width_px = 1140;
  plot.description = figure.title;
  plot.x = {"frame", /*integers=*/true, {}, {}};
  plot.y = {"points", /*integers=*/true, 0.0, {}};
  plot.bands = StateBands(run);
  if (AnyPose(run)) {
    const auto when_posed = [](int FrameRecord::*count) {
      return [count](const FrameRecord& frame) {
        return frame.world_from_cam ? static_cast<double>(frame.*count) : kGap;
      };
    };
    plot.series = {
        FrameSeries(run, "matched", PlotColor::kSky, when_posed(&FrameRecord::num_matches)),
        FrameSeries(run, "tracked (agree with the pose)", PlotColor::kBlue,
                    when_posed(&FrameRecord::num_inliers)),
        KeyframeRug(run)};
    return figure;
  }
  figure.title = "Features and matches per frame";
  plot.series = {
      FrameSeries(run, "features", PlotColor::kSky,
                  [](const FrameRecord& f) { return static_cast<double>(f.num_features); }),
      FrameSeries(run, "matched with the reference frame", PlotColor::kBlue,
                  [](const FrameRecord& f) { return static_cast<double>(f.num_matches); })};
  return figure;
}

std::vector<Figure> ThresholdFigures(const RunRecord& run) {
  const auto when_tracked = [](auto FrameRecord::*value) {
    return [value](const FrameRecord& f) {
      return f.high_threshold > 0.0F ? static_cast<double>(f.*value) : kGap;
    };
  };
  Plot plot;
  plot.width_px = 1140;
  plot.height_px = 200;
  plot.x = {"frame", /*integers=*/true, {}, {}};
  Figure thresholds{"Matching thresholds", plot, {}};
  thresholds.plot.description = "Adaptive matching thresholds of each frame";
  thresholds.plot.y = {"distance", false, {}, {}};
  thresholds.plot.series = {FrameSeries(run, "high (guided)", PlotColor::kVermilion,
                                        when_tracked(&FrameRecord::high_threshold)),
                            FrameSeries(run, "low (strict)", PlotColor::kBlue,
                                        when_tracked(&FrameRecord::low_threshold))};
  std::set<float> values;
  for (const FrameRecord& frame : run.frames) {
    if (frame.high_threshold > 0.0F) values.insert(frame.high_threshold);
  }
  if (values.size() < 2) return {};
  Figure matches{"Matches with the last frame", plot,
                 "The thresholds rise when the matches that agree with the pose get few. New map "
                 "points of LIFT are always made with the strict one."};
  matches.plot.description = matches.title;
  matches.plot.y = {"points", /*integers=*/true, 0.0, {}};
  matches.plot.series = {FrameSeries(run, "matched map points", PlotColor::kSky,
                                     when_tracked(&FrameRecord::num_last_matches)),
                         FrameSeries(run, "outliers", PlotColor::kOrange,
                                     when_tracked(&FrameRecord::num_last_outliers))};
  return {std::move(thresholds), std::move(matches)};
}

Figure StageTimesFigure(const RunRecord& run) {
  Figure figure{"Time per frame", {}, {}};
  Plot& plot = figure.plot;
  plot.width_px = 1140;
  plot.description = "Time of extraction, tracking and mapping per frame";
  plot.x = {"frame", /*integers=*/true, {}, {}};
  plot.y = {"time [ms]", false, 0.0, {}};
  const std::size_t per_bar = (run.frames.size() + kMaxBars - 1) / kMaxBars;
  plot.series = {TimeBars(run, std::max<std::size_t>(1, per_bar), "feature extraction",
                          PlotColor::kSky, &FrameRecord::extract_ms),
                 TimeBars(run, std::max<std::size_t>(1, per_bar), "tracking", PlotColor::kBlue,
                          &FrameRecord::track_ms),
                 TimeBars(run, std::max<std::size_t>(1, per_bar), "local mapping",
                          PlotColor::kOrange, &FrameRecord::map_ms)};
  const int beyond = LimitHeight(plot);
  if (!run.frames.empty()) {
    const auto& bars = plot.series.front().x;
    const double half = bars.size() > 1 ? 0.5 * (bars[1] - bars[0]) : 0.5;
    plot.x.min = bars.front() - half;
    plot.x.max = bars.back() + half;
  }
  figure.note = StageNote(run, per_bar, beyond);
  return figure;
}

Figure MapFigure(const RunRecord& run, const ReportScene& scene, const ScenePath& path) {
  Figure figure{"Map from above", TopViewPlot(scene), {}};
  Plot& plot = figure.plot;
  plot.description = figure.title;
  const MapExtent extent = ExtentOf(run, scene, path, kMapPlotAspect);
  plot.images.push_back(RasterOfPoints(run, scene, path, extent, 1000));
  plot.series.push_back(
      {"camera path", SeriesKind::kLine, PlotColor::kBlue, path.right, path.up, 1.6});
  PlotSeries keyframes{"keyframe", SeriesKind::kPoints, PlotColor::kOrange, {}, {}, 4.4};
  for (const KeyFrameRecord& keyframe : run.keyframes) {
    if (!scene.Shows(path, keyframe.map_index)) continue;
    const Eigen::Vector3d x = scene.OnPage(keyframe.pose.world_from_cam.translation);
    keyframes.x.push_back(x.x());
    keyframes.y.push_back(x.y());
  }
  plot.series.push_back(std::move(keyframes));
  return figure;
}

}  // namespace lift_slam
