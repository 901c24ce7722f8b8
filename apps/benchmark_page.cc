#include "apps/benchmark_page.h"

#include <fmt/format.h>

#include "lift_slam/visualization/report_style.h"
#include "lift_slam/visualization/svg_plot.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr const char* kStyle = R"css(
table.results{width:auto}table.results th{white-space:nowrap;padding-right:12px}
table.results .num{padding:5px 8px;white-space:nowrap}table.results thead th:first-child{vertical-align:bottom;color:var(--text);font-weight:600}
table.results tbody.others{color:var(--soft)}table.results .source{padding-top:14px;font-size:12.5px;font-style:italic;border-top:2px solid var(--rule)}
table.results thead .num{white-space:normal;max-width:13em;vertical-align:bottom}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(440px,1fr));gap:26px 28px;align-items:start}
.remarks{color:var(--soft);font-size:13px;max-width:75em}.remarks p{margin:6px 0 0}
)css";

std::string PicturesHtml(const std::vector<BenchmarkPicture>& pictures) {
  std::string html, section;
  for (const BenchmarkPicture& picture : pictures) {
    if (picture.section != section) {
      if (!section.empty()) html += "</div>\n";
      section = picture.section;
      html += "<h2>" + EscapeXml(section) + "</h2>\n<div class=\"pictures\">\n";
    }
    html += "<figure><figcaption>" + EscapeXml(picture.title) + "</figcaption>" + picture.svg;
    if (!picture.note.empty()) html += "<p class=\"note\">" + EscapeXml(picture.note) + "</p>";
    html += "</figure>\n";
  }
  return section.empty() ? html : html + "</div>\n";
}

}  // namespace

std::string BenchmarkPage(const BenchmarkPlan& plan, const std::vector<ResultTable>& tables,
                          const ResultTable& statistics,
                          const std::vector<BenchmarkPicture>& pictures,
                          const std::vector<std::string>& remarks) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<title>Benchmark: {0}</title>\n<style>{1}"
      "{2}{3}</style></head><body>\n<p class=\"kicker\">Benchmark</p><h1>{0}</h1>\n<main>\n"
      "<h2>Results</h2>\n",
      EscapeXml(plan.suite), PlotStyleSheet(), ReportStyleSheet(), kStyle);
  for (const ResultTable& table : tables) html += HtmlTable(table);
  html += "<div class=\"remarks\">";
  for (const std::string& remark : remarks) html += "<p>" + EscapeXml(remark) + "</p>";
  html += "</div>\n" + PicturesHtml(pictures);
  html += "<h2>All statistics</h2>\n" + HtmlTable(statistics);
  return html + "</main></body></html>\n";
}

}  // namespace lift_slam
