#include <cmath>

#include "apps/benchmark_matching.h"
#include "lift_slam/visualization/dot_chart.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kLaneStep = 0.08;  // frames between the bars of two kinds of features
constexpr PlotColor kColors[] = {PlotColor::kVermilion, PlotColor::kGreen,  PlotColor::kBlue,
                                 PlotColor::kOrange,    PlotColor::kPurple, PlotColor::kSky};

PlotColor ColorOf(std::size_t lane) { return kColors[lane % std::size(kColors)]; }

// By condition in the order of the plan; null where a condition has no pairs.
std::vector<const MatchingCell*> CellsOf(const BenchmarkPlan& plan,
                                         const std::vector<MatchingCell>& cells,
                                         const std::string& title, const std::string& sequence) {
  std::vector<const MatchingCell*> found;
  for (const std::string& condition : plan.conditions) {
    found.push_back(nullptr);
    for (const MatchingCell& cell : cells) {
      const bool fits =
          cell.title == title && cell.sequence == sequence && cell.condition == condition;
      if (fits) found.back() = &cell;
    }
  }
  return found;
}

// "t+3" gives 3; a gamma gives 0.
int SkipOf(const std::string& condition) {
  return condition.starts_with("t+") ? std::stoi(condition.substr(2)) : 0;
}

// A line through the means, and a bar over the middle half of the pairs at each.
void AddSkipSeries(const std::string& title, const std::vector<const MatchingCell*>& cells,
                   std::size_t lane, double offset, Plot& plot) {
  PlotSeries line{title, SeriesKind::kLine, ColorOf(lane), {}, {}, 1.8};
  PlotSeries bars{"", SeriesKind::kLine, ColorOf(lane), {}, {}, 1.0};
  for (const MatchingCell* cell : cells) {
    if (cell == nullptr || SkipOf(cell->condition) == 0) continue;
    const double x = SkipOf(cell->condition) + offset;
    line.x.push_back(x);
    line.y.push_back(cell->mean_inliers);
    bars.x.insert(bars.x.end(), {x, x, kGap});
    bars.y.insert(bars.y.end(), {cell->Quantile(0.25), cell->Quantile(0.75), kGap});
  }
  if (line.x.empty()) return;
  PlotSeries dots = line;
  dots.label.clear();
  dots.kind = SeriesKind::kPoints;
  dots.size_px = 4.5;
  plot.series.push_back(std::move(bars));
  plot.series.push_back(std::move(line));
  plot.series.push_back(std::move(dots));
}

void AddGammaSeries(const std::string& title, const std::vector<const MatchingCell*>& cells,
                    std::size_t lane, DotChart& chart) {
  DotSeries series{title, ColorOf(lane), {}};
  bool is_known = false;
  for (const std::string& category : chart.categories) {
    series.values.push_back(DotSeries::kNone);
    series.low.push_back(DotSeries::kNone);
    series.high.push_back(DotSeries::kNone);
    for (const MatchingCell* cell : cells) {
      if (cell == nullptr || cell->condition != category) continue;
      series.values.back() = cell->mean_inliers;
      series.low.back() = cell->Quantile(0.25);
      series.high.back() = cell->Quantile(0.75);
      is_known = true;
    }
  }
  if (is_known) chart.series.push_back(std::move(series));
}

Plot EmptySkipPlot(const std::string& sequence) {
  Plot plot;
  plot.description = "Inliers against frame skip on " + sequence;
  plot.x = {"frames apart", /*integers=*/true, 0.5, 10.5};
  plot.y = {"inliers", false, 0.0, {}};
  return plot;
}

DotChart EmptyGammaChart(const std::string& sequence) {
  DotChart chart;
  chart.description = "Inliers under gamma on " + sequence;
  chart.axis.label = "inliers";
  chart.categories = {"gamma=0.25", "gamma=0.5", "t+5", "gamma=2", "gamma=4"};
  return chart;
}

}  // namespace

std::vector<BenchmarkPicture> MatchingPictures(const BenchmarkPlan& plan,
                                               const std::vector<MatchingCell>& cells) {
  std::vector<BenchmarkPicture> skips, gammas;
  for (const std::string& sequence : plan.sequences) {
    Plot plot = EmptySkipPlot(sequence);
    DotChart chart = EmptyGammaChart(sequence);
    for (std::size_t lane = 0; lane < plan.titles.size(); ++lane) {
      const auto found = CellsOf(plan, cells, plan.titles[lane], sequence);
      const double middle = 0.5 * static_cast<double>(plan.titles.size() - 1);
      AddSkipSeries(plan.titles[lane], found, lane,
                    kLaneStep * (static_cast<double>(lane) - middle), plot);
      AddGammaSeries(plan.titles[lane], found, lane, chart);
    }
    if (plot.series.empty()) continue;
    const char* note = "Mean of the pairs; bar: the middle half of them.";
    skips.push_back(MakePicture("Inliers by frame skip", "skip_" + sequence, sequence, note, plot));
    gammas.push_back(MakePicture("Inliers by gamma of the second image, 5 frames later",
                                 "gamma_" + sequence, sequence, note, chart));
  }
  skips.insert(skips.end(), gammas.begin(), gammas.end());
  return skips;
}

}  // namespace lift_slam
