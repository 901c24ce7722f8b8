#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lift_slam {

// What stands in a cell of a table, and whether it may win.
struct TableEntry {
  std::string text;
  std::optional<double> contender;
  bool is_bold = false;
};

struct BenchmarkTableRow {
  std::string title;
  std::vector<TableEntry> entries;  // one for each column
  std::string source = {};          // of numbers that others published; empty: ours

  // "ORB-SLAM [LIFT-SLAM paper, Table 2]"
  std::string FullTitle() const { return source.empty() ? title : title + " [" + source + "]"; }
};

struct ResultTable {
  std::string title;  // of the figure, with its unit
  std::vector<std::string> columns;
  std::vector<BenchmarkTableRow> ours, others;
};

// Rows become columns; others' rows stand right of ours.
ResultTable Transposed(const ResultTable& table);

std::string MarkdownTable(const ResultTable& table);
std::string HtmlTable(const ResultTable& table);
std::string LatexTable(const ResultTable& table);
// Several figures of the same rows and columns as one table, as the paper lays out its Tables 2, 3
// and 5: for each row of the first table a line for each figure. A row that a later table lacks has
// no line for it.
std::string LatexTableByRow(const std::vector<ResultTable>& tables);
// As its Table 4: for each column of the first table a column for each figure.
std::string LatexTableByColumn(const std::vector<ResultTable>& tables);

std::string EscapeLatex(const std::string& text);

}  // namespace lift_slam
