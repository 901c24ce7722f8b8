#include "lift_slam/visualization/report_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/visualization/frame_gallery.h"
#include "lift_slam/visualization/map_viewer.h"
#include "lift_slam/visualization/report_figures.h"
#include "lift_slam/visualization/report_style.h"
#include "lift_slam/visualization/report_tables.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr std::size_t kMaxMapsDrawn = 4;

std::string FigureHtml(const Figure& figure, const char* css_class = "") {
  const std::string note =
      figure.note.empty() ? "" : "<p class=\"note\">" + EscapeXml(figure.note) + "</p>";
  return fmt::format(
      "<figure class=\"{}\"><figcaption>{}</figcaption><div class=\"scroll\">{}</div>{}"
      "</figure>\n",
      css_class, EscapeXml(figure.title), RenderSvg(figure.plot), note);
}

std::string Section(const char* id, const char* title, const std::string& content) {
  if (content.empty()) return {};
  return fmt::format("<section id=\"{0}\"><h2>{1}</h2>\n{2}</section>\n", id, title, content);
}

std::string Pair(const std::string& left, const std::string& right) {
  return "<div class=\"pair\">" + left + right + "</div>\n";
}

std::string Paragraph(const std::string& text) {
  return text.empty() ? "" : "<p>" + EscapeXml(text) + "</p>";
}

std::string HeaderHtml(const ReportData& data) {
  const char* look = data.status == ReportStatus::kOk        ? "s-ok"
                     : data.status == ReportStatus::kPartial ? "s-mid"
                                                             : "s-bad";
  return fmt::format(
      "<header><p class=\"kicker\">{}</p><h1>{}</h1>\n<div class=\"status {}\" "
      "id=\"status\"><b>{}</b>"
      "<div>{}{}</div></div>\n{}</header>\n",
      EscapeXml(data.title), EscapeXml(data.sequence), look, EscapeXml(data.status_label),
      Paragraph(data.summary), Paragraph(data.advice), KeyNumbersHtml(data.key_numbers));
}

// Instead of the trajectory when no map was made.
std::string NoMapNotice(const RunRecord& run) {
  std::string reasons;
  for (const FrameRefusal refusal : RefusalsByCount(run)) {
    if (refusal == FrameRefusal::kFirstFrame) continue;
    reasons += fmt::format("<li><b>{} of {} frames</b> {}</li>\n",
                           run.refusals[static_cast<std::size_t>(refusal)], run.frames.size(),
                           EscapeXml(Explain(refusal)));
  }
  return "<div class=\"notice\"><strong>No map was made, so there is no "
         "trajectory.</strong><ul>\n" +
         reasons + "</ul></div>\n";
}

// The largest maps, by time; a note says how many are left out.
std::vector<const ScenePath*> MapsToDraw(const ReportScene& scene, std::string& note) {
  std::vector<const ScenePath*> maps;
  for (const ScenePath& path : scene.paths()) maps.push_back(&path);
  if (maps.size() > 1) {
    note = "The maps are not connected: each has its own origin, direction and scale.";
  }
  if (maps.size() <= kMaxMapsDrawn) return maps;
  note += fmt::format(" The {} largest of {} maps are drawn.", kMaxMapsDrawn, maps.size());
  std::stable_sort(maps.begin(), maps.end(), [](const ScenePath* a, const ScenePath* b) {
    return a->right.size() > b->right.size();
  });
  maps.resize(kMaxMapsDrawn);
  std::sort(maps.begin(), maps.end(),
            [](const ScenePath* a, const ScenePath* b) { return a->map_index < b->map_index; });
  return maps;
}

std::string NoteHtml(const std::string& note) {
  return note.empty() ? "" : "<p class=\"note\">" + EscapeXml(note) + "</p>\n";
}

std::string TrajectoryHtml(const RunRecord& run, const ReportScene& scene, const ReportData& data) {
  if (scene.paths().empty()) return NoMapNotice(run);
  Figure height = HeightFigure(scene);
  std::string note;
  const std::vector<const ScenePath*> maps = MapsToDraw(scene, note);
  if (maps.size() > 1) {
    std::string figures;
    for (const ScenePath* path : maps) {
      Figure figure = TopViewFigure(scene, *path);
      figure.title = fmt::format("Map {}, top view", path->map_index + 1);
      figure.plot.height_px = 340;
      figures += FigureHtml(figure);
    }
    height.plot.width_px = 1140;
    return Pair(figures, "") + NoteHtml(note) + "<br>" + FigureHtml(height, "wide");
  }
  Figure top = TopViewFigure(scene, *maps.front());
  if (data.errors.empty()) {
    top.plot.height_px = height.plot.height_px = 420;
    if (!scene.aligned()) {
      note =
          "A single camera cannot know the scale of the world: lengths are in map units, in the "
          "frame of the map's first camera.";
    }
    return Pair(FigureHtml(top), FigureHtml(height)) + NoteHtml(note);
  }
  top.plot.height_px = 568;
  height.plot.height_px = 262;
  Figure error = ErrorFigure(scene, data);
  error.plot.height_px = 262;
  return Pair(FigureHtml(top),
              "<div class=\"stack\">" + FigureHtml(height) + FigureHtml(error) + "</div>");
}

std::string MapHtml(const RunRecord& run, const ReportScene& scene) {
  if (scene.paths().empty()) return {};
  std::string note;
  const std::vector<const ScenePath*> maps = MapsToDraw(scene, note);
  std::string figures;
  for (const ScenePath* path : maps) {
    Figure figure = MapFigure(run, scene, *path);
    if (maps.size() > 1) figure.title = fmt::format("Map {} from above", path->map_index + 1);
    figures += FigureHtml(figure);
  }
  const std::string viewer =
      "<figure><figcaption>Map in three dimensions</figcaption>" + MapViewerHtml(run, scene) +
      "<p class=\"note\">Drag to turn, shift-drag to move, wheel to zoom, double-click to start "
      "again.</p></figure>\n";
  return Pair(figures, viewer) + NoteHtml(note);
}

std::string TablesHtml(const RunRecord& run, const ReportData& data) {
  std::string html;
  for (const ReportTable& table : data.tables) html += TableHtml(table);
  html += CountersHtml(run);
  return html.empty() ? html : "<div class=\"columns\">" + html + "</div>\n";
}

std::string Scrolling(const std::string& table) {
  return table.empty() ? table : "<div class=\"scroll\">" + table + "</div>\n";
}

std::string BackgroundHtml(const ReportData& data) {
  std::string html;
  if (!data.provenance.rows.empty()) {
    html += "<details open><summary>Provenance</summary>" + TableHtml({"", data.provenance.rows}) +
            "</details>\n";
  }
  if (!data.configuration.empty()) {
    html += "<details><summary>Effective configuration</summary><pre>" +
            EscapeXml(data.configuration) + "</pre></details>\n";
  }
  return html;
}

}  // namespace

std::string ReportHtml(const RunRecord& run, const ReportData& data) {
  const ReportScene scene(run, data);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<title>{}: {}</title>\n<style>{}{}</style>"
      "</head><body>\n",
      EscapeXml(data.sequence), EscapeXml(data.status_label), PlotStyleSheet(), ReportStyleSheet());
  html += HeaderHtml(data) + "<main>\n";
  html += Section("trajectory", "Trajectory", TrajectoryHtml(run, scene, data));
  const bool any_frame = !run.frames.empty();
  std::string thresholds;
  for (const Figure& figure : ThresholdFigures(run)) thresholds += FigureHtml(figure, "wide");
  html += Section("tracking", "Tracking",
                  (any_frame ? FigureHtml(TrackingFigure(run), "wide") : "") + thresholds + "<br>" +
                      Scrolling(StatesHtml(run)) + Scrolling(RefusalsHtml(run)));
  html += Section("time", "Time",
                  (any_frame ? FigureHtml(StageTimesFigure(run), "wide") + "<br>" : "") +
                      Scrolling(StageTimesHtml(run.stage_times_ms)));
  html += Section("map", "Map", MapHtml(run, scene));
  html += Section("frames", "Frames", FrameGalleryHtml(run));
  html += Section("numbers", "All numbers", TablesHtml(run, data));
  html += Section("background", "Provenance and configuration", BackgroundHtml(data));
  return html + "</main></body></html>\n";
}

}  // namespace lift_slam
