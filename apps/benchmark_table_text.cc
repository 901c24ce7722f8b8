#include "apps/benchmark_table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

std::string Replace(const std::string& text, const std::map<char, std::string>& replacements) {
  std::string result;
  for (const char c : text) {
    const auto found = replacements.find(c);
    result += found == replacements.end() ? std::string(1, c) : found->second;
  }
  return result;
}

std::string EscapeMarkdown(const std::string& text) { return Replace(text, {{'|', "\\|"}}); }

std::string MarkdownRow(const std::string& title, const std::vector<TableEntry>& entries) {
  std::string text = "| " + EscapeMarkdown(title);
  for (const TableEntry& entry : entries) {
    const std::string cell = EscapeMarkdown(entry.text);
    text += " | " + (entry.is_bold ? "**" + cell + "**" : cell);
  }
  return text + " |\n";
}

std::string HtmlRow(const BenchmarkTableRow& row) {
  std::string text = "<tr><th>" + EscapeXml(row.title) + "</th>";
  for (const TableEntry& entry : row.entries) {
    const std::string cell = EscapeXml(entry.text);
    text += "<td class=\"num\">" + (entry.is_bold ? "<b>" + cell + "</b>" : cell) + "</td>";
  }
  return text + "</tr>\n";
}

// Begins the rows of a publication; ends those of the one before.
std::string HtmlSourceRow(const std::string& source, std::size_t num_columns,
                          const std::string& last_source) {
  return fmt::format(
      "{}<tbody class=\"others\"><tr><th class=\"source\" colspan=\"{}\">{}</th></tr>\n",
      last_source.empty() ? "" : "</tbody>\n", num_columns + 1, EscapeXml(source));
}

// " & a & \textbf{b}"
std::string LatexCells(const std::vector<TableEntry>& entries) {
  std::string text;
  for (const TableEntry& entry : entries) {
    const std::string cell = EscapeLatex(entry.text);
    text += " & " + (entry.is_bold ? "\\textbf{" + cell + "}" : cell);
  }
  return text;
}

std::string LatexHeader(const std::string& titles, const std::vector<std::string>& columns) {
  std::string text = titles;
  for (const std::string& column : columns) text += " & " + EscapeLatex(column);
  return text + " \\\\\n\\hline\n";
}

std::string LatexBegin(std::size_t num_titles, std::size_t num_columns) {
  return fmt::format("\\begin{{tabular}}{{{}{}}}\n\\hline\n", std::string(num_titles, 'l'),
                     std::string(num_columns, 'r'));
}

constexpr const char* kLatexEnd = "\\hline\n\\end{tabular}\n\n";

std::vector<BenchmarkTableRow> AllRows(const ResultTable& table) {
  std::vector<BenchmarkTableRow> rows = table.ours;
  rows.insert(rows.end(), table.others.begin(), table.others.end());
  return rows;
}

// Titles of the rows of all tables, each once.
std::vector<std::string> RowTitles(const std::vector<ResultTable>& tables) {
  std::vector<std::string> titles;
  for (const ResultTable& table : tables) {
    for (const BenchmarkTableRow& row : AllRows(table)) {
      const std::string title = row.FullTitle();
      if (std::ranges::find(titles, title) == titles.end()) titles.push_back(title);
    }
  }
  return titles;
}

}  // namespace

std::string EscapeLatex(const std::string& text) {
  return Replace(text, {{'%', "\\%"}, {'_', "\\_"}, {'&', "\\&"}, {'#', "\\#"}});
}

ResultTable Transposed(const ResultTable& table) {
  ResultTable result{table.title, {}, {}, {}};
  const std::vector<BenchmarkTableRow> rows = AllRows(table);
  for (const BenchmarkTableRow& row : rows) result.columns.push_back(row.FullTitle());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    BenchmarkTableRow turned{table.columns[i], {}};
    for (const BenchmarkTableRow& row : rows) turned.entries.push_back(row.entries[i]);
    result.ours.push_back(std::move(turned));
  }
  return result;
}

std::string MarkdownTable(const ResultTable& table) {
  std::vector<TableEntry> header;
  std::string rule = "| ---";
  for (const std::string& column : table.columns) {
    header.push_back({column, {}});
    rule += " | ---:";
  }
  std::string text = MarkdownRow(table.title, header) + rule + " |\n";
  for (const BenchmarkTableRow& row : AllRows(table))
    text += MarkdownRow(row.FullTitle(), row.entries);
  return text + "\n";
}

std::string HtmlTable(const ResultTable& table) {
  std::string text = "<div class=\"scroll\"><table class=\"results\"><thead><tr><th>" +
                     EscapeXml(table.title) + "</th>";
  for (const std::string& column : table.columns) {
    text += "<th class=\"num\">" + EscapeXml(column) + "</th>";
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const BenchmarkTableRow& row : table.ours) text += HtmlRow(row);
  text += "</tbody>\n";
  std::string source;
  for (const BenchmarkTableRow& row : table.others) {
    if (row.source != source) text += HtmlSourceRow(row.source, table.columns.size(), source);
    source = row.source;
    text += HtmlRow(row);
  }
  if (!table.others.empty()) text += "</tbody>\n";
  return text + "</table></div>\n";
}

std::string LatexTable(const ResultTable& table) {
  std::string text =
      LatexBegin(1, table.columns.size()) + LatexHeader(EscapeLatex(table.title), table.columns);
  for (const BenchmarkTableRow& row : table.ours) {
    text += EscapeLatex(row.FullTitle()) + LatexCells(row.entries) + " \\\\\n";
  }
  if (!table.others.empty()) text += "\\hline\n";
  for (const BenchmarkTableRow& row : table.others) {
    text += EscapeLatex(row.FullTitle()) + LatexCells(row.entries) + " \\\\\n";
  }
  return text + kLatexEnd;
}

std::string LatexTableByRow(const std::vector<ResultTable>& tables) {
  const std::vector<std::string>& columns = tables.front().columns;
  std::string text = LatexBegin(2, columns.size()) + LatexHeader("Algorithm & Metric", columns);
  for (const std::string& title : RowTitles(tables)) {
    std::string shown = EscapeLatex(title);
    for (const ResultTable& table : tables) {
      for (const BenchmarkTableRow& row : AllRows(table)) {
        if (row.FullTitle() != title) continue;
        text += shown + " & " + EscapeLatex(table.title) + LatexCells(row.entries) + " \\\\\n";
        shown.clear();
      }
    }
    text += "\\hline\n";
  }
  return text + kLatexEnd;
}

std::string LatexTableByColumn(const std::vector<ResultTable>& tables) {
  const ResultTable& first = tables.front();
  std::vector<std::string> columns;
  std::string systems = "Sequence, distortion";
  for (const std::string& column : first.columns) {
    systems += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", tables.size(), EscapeLatex(column));
    for (const ResultTable& table : tables) columns.push_back(table.title);
  }
  std::string text = LatexBegin(1, columns.size()) + systems + " \\\\\n" + LatexHeader("", columns);
  for (std::size_t i = 0; i < first.ours.size(); ++i) {
    std::vector<TableEntry> entries;
    for (const std::string& column : first.columns) {
      for (const ResultTable& table : tables) {
        const auto at = std::ranges::find(table.columns, column) - table.columns.begin();
        const bool is_there = at < std::ssize(table.columns);
        entries.push_back(is_there ? table.ours[i].entries[static_cast<std::size_t>(at)]
                                   : TableEntry{"-", {}});
      }
    }
    text += EscapeLatex(first.ours[i].title) + LatexCells(entries) + " \\\\\n";
  }
  return text + kLatexEnd;
}

}  // namespace lift_slam
