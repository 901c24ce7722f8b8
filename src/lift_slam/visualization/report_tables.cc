#include "lift_slam/visualization/report_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/visualization/time_summary.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

std::string WithSpaces(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return EscapeXml(text);
}

std::string Capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string ValueAndUnit(const ReportRow& row) {
  if (row.unit.empty()) return EscapeXml(row.value);
  return fmt::format("{} <span class=\"unit\">{}</span>", EscapeXml(row.value),
                     EscapeXml(row.unit));
}

// A count as a bar of its share.
std::string ShareCells(int count, std::size_t total) {
  const double percent = total > 0 ? 100.0 * count / static_cast<double>(total) : 0.0;
  return fmt::format(
      "<td class=\"num\">{}</td><td class=\"num\">{:.1f} %</td>"
      "<td class=\"share\">{}</td>",
      count, percent, count > 0 ? fmt::format("<i style=\"width:{:.1f}%\"></i>", percent) : "");
}

// All that were accepted, and the first that were refused.
std::vector<PlaceEvent> PlacesToList(const RunRecord& run) {
  constexpr int kMaxRefused = 30;
  std::vector<PlaceEvent> events;
  int refused = 0;
  for (const PlaceEvent& event : run.place_events) {
    const bool is_accepted = event.rejection == PlaceRejection::kAccepted;
    if (is_accepted || ++refused <= kMaxRefused) events.push_back(event);
  }
  return events;
}

std::string PlaceRow(const PlaceEvent& event) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td>"
      "<td class=\"num\">{:.3f}</td><td class=\"num\">{}</td><td class=\"num\">{}</td>"
      "<td class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{:.3f}</td>"
      "<td class=\"note\">{}</td></tr>\n",
      Name(event.kind), event.frame_index, event.other_frame_index, event.score,
      event.num_word_matches, event.num_inliers, event.num_projected, event.num_confirming,
      event.scale, EscapeXml(Explain(event.rejection)));
}

}  // namespace

std::string KeyNumbersHtml(const std::vector<ReportRow>& rows) {
  std::string html = "<dl class=\"key\">\n";
  for (const ReportRow& row : rows) {
    html +=
        fmt::format("<div><dt>{}</dt><dd>{}</dd>{}</div>\n", EscapeXml(row.name), ValueAndUnit(row),
                    row.note.empty() ? "" : "<p>" + EscapeXml(row.note) + "</p>");
  }
  return html + "</dl>\n";
}

std::string TableHtml(const ReportTable& table) {
  if (table.rows.empty()) return {};
  const bool notes = std::any_of(table.rows.begin(), table.rows.end(),
                                 [](const ReportRow& row) { return !row.note.empty(); });
  std::string html = fmt::format("<table><caption>{}</caption><tbody>\n", EscapeXml(table.title));
  for (const ReportRow& row : table.rows) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"val\">{}</td>{}</tr>\n",
                        EscapeXml(row.name), ValueAndUnit(row),
                        notes ? "<td class=\"note\">" + EscapeXml(row.note) + "</td>" : "");
  }
  return html + "</tbody></table>\n";
}

std::string StatesHtml(const RunRecord& run) {
  std::string html =
      "<table class=\"narrow\"><caption>State after each "
      "frame</caption><thead><tr><th>state</th><th "
      "class=\"num\">frames</th><th class=\"num\">share</th><th></th></tr></thead><tbody>\n";
  for (const TrackingState state :
       {TrackingState::kInitializing, TrackingState::kTracking, TrackingState::kLost}) {
    const auto count =
        std::count_if(run.frames.begin(), run.frames.end(),
                      [&](const FrameRecord& frame) { return frame.state == state; });
    html += fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", WithSpaces(Name(state)),
                        ShareCells(static_cast<int>(count), run.frames.size()));
  }
  return html + "</tbody></table>\n";
}

std::vector<FrameRefusal> RefusalsByCount(const RunRecord& run) {
  std::vector<FrameRefusal> refusals;
  for (std::size_t i = 1; i < run.refusals.size(); ++i) {
    if (run.refusals[i] > 0) refusals.push_back(static_cast<FrameRefusal>(i));
  }
  std::stable_sort(refusals.begin(), refusals.end(), [&](FrameRefusal a, FrameRefusal b) {
    return run.refusals[static_cast<std::size_t>(a)] > run.refusals[static_cast<std::size_t>(b)];
  });
  return refusals;
}

std::string RefusalsHtml(const RunRecord& run) {
  std::string rows;
  for (const FrameRefusal refusal : RefusalsByCount(run)) {
    const auto i = static_cast<std::size_t>(refusal);
    rows += fmt::format("<tr><th scope=\"row\">{}</th>{}<td class=\"note\">{}</td></tr>\n",
                        WithSpaces(Name(refusal)), ShareCells(run.refusals[i], run.frames.size()),
                        EscapeXml(Explain(refusal)));
  }
  if (rows.empty()) return {};
  return "<table><caption>Why frames have no pose</caption><thead><tr><th>reason</th><th "
         "class=\"num\">frames</th><th class=\"num\">share</th><th></th><th>what it means</th></tr>"
         "</thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string StageTimesHtml(const StageTimes& times_ms) {
  std::string rows;
  for (const auto& [stage, times] : times_ms) {
    if (times.empty()) continue;
    const TimeSummary t = SummarizeTimes(times);
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{:.1f}</td>"
        "<td class=\"num\">{:.1f}</td><td class=\"num\">{:.1f}</td><td class=\"num\">{:.1f}</td>"
        "<td class=\"num\">{:.2f}</td></tr>\n",
        Capitalized(WithSpaces(stage)), t.runs, t.median_ms, t.mean_ms, t.p95_ms, t.max_ms,
        t.total_s);
  }
  if (rows.empty()) return {};
  return "<table><caption>Time of each stage</caption><thead><tr><th>stage</th><th "
         "class=\"num\">runs"
         "</th><th class=\"num\">median [ms]</th><th class=\"num\">mean [ms]</th><th "
         "class=\"num\">95 "
         "% below [ms]</th><th class=\"num\">slowest [ms]</th><th class=\"num\">total [s]</th></tr>"
         "</thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string PlacesHtml(const RunRecord& run) {
  std::string html;
  if (!run.place_recognition_notice.empty()) {
    html = "<p class=\"note\">Places seen before are not recognised: " +
           EscapeXml(run.place_recognition_notice) + ".</p>\n";
  }
  const std::vector<PlaceEvent> events = PlacesToList(run);
  if (events.empty()) return html;
  html +=
      "<table><caption>Places seen before</caption><thead><tr><th>what</th><th class=\"num\">frame"
      "</th><th class=\"num\">looks like</th><th class=\"num\">score</th><th class=\"num\">by "
      "words</th><th class=\"num\">agree</th><th class=\"num\">seen</th><th class=\"num\">"
      "neighbours</th><th class=\"num\">scale</th><th>result</th></tr></thead><tbody>\n";
  for (const PlaceEvent& event : events) html += PlaceRow(event);
  html += "</tbody></table>\n";
  if (events.size() < run.place_events.size()) {
    html += fmt::format("<p class=\"note\">{} more were refused.</p>\n",
                        run.place_events.size() - events.size());
  }
  return html;
}

std::string CountersHtml(const RunRecord& run) {
  if (run.counters.empty()) return {};
  std::string html, stage;
  for (const auto& [key, count] : run.counters) {
    const std::size_t dot = key.find('.');
    const std::string of = dot == std::string::npos ? "other" : key.substr(0, dot);
    const std::string reason = dot == std::string::npos ? key : key.substr(dot + 1);
    if (of != stage) {
      html += fmt::format("{}<table><caption>{}</caption><tbody>\n",
                          stage.empty() ? "" : "</tbody></table>\n", Capitalized(WithSpaces(of)));
      stage = of;
    }
    html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td></tr>\n",
                        WithSpaces(reason), count);
  }
  return html + "</tbody></table>\n";
}

}  // namespace lift_slam
