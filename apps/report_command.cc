#include "apps/report_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <set>

#include "lift_slam/evaluation/run_report.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

struct Arguments {
  std::vector<std::string> inputs;
  std::string output;
  bool csv = false;
};

void WriteTables(const Arguments& arguments) {
  std::vector<std::filesystem::path> files;  // each once, though folders given may overlap
  std::set<std::filesystem::path> known;
  for (const std::string& input : arguments.inputs) {
    const auto found = FindResultFiles(input);
    for (const std::filesystem::path& file : found) {
      const bool is_new = known.insert(std::filesystem::weakly_canonical(file)).second;
      if (is_new) files.push_back(file);
    }
  }
  const RunReport report = BuildReport(files);
  if (!arguments.output.empty()) {
    const std::filesystem::path folder = arguments.output;
    CreateFolder(folder);
    WriteTextAtomically(folder / "report.md", report.markdown);
    WriteTextAtomically(folder / "report.csv", report.csv);
  }
  std::cout << (arguments.csv ? report.csv : report.markdown);
}

}  // namespace

void AddReportCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("report", "Merge the result.json of many runs into tables");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("DIR", arguments->inputs, "Folders searched for result.json, or such files")
      ->required();
  command->add_option("--output", arguments->output, "Folder for report.md and report.csv");
  command->add_flag("--csv", arguments->csv, "Print CSV instead of Markdown");
  command->footer(
      "Examples:\n"
      "  lift_slam report runs/\n"
      "  lift_slam report runs/kitti_00 runs/kitti_06 --output tables");
  command->callback([arguments] { WriteTables(*arguments); });
}

}  // namespace lift_slam
